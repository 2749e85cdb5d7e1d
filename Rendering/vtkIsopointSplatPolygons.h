// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class   vtkIsopointSplatPolygons
 * @brief   turns isopoints into the triangles of their splats
 *
 * Each point becomes a splat: a fan of triangles around it, with a normal at each vertex. Together
 * the splats of isopoints form a surface for any mapper, filter, writer or exporter.
 *
 * Input is a data set with points, or a composite of such. Arrays determine the shape of a splat:
 * - with the cell arrays "SplatAxis" and "SplatPolygon" from vtkScatteredIsopointFilter, on the
 *   first VTK_VERTEX of the point, and active point normals: up to eight corners, each with its own
 *   height and normal. Both may also be point arrays;
 * - without these, or if the axis is not orthogonal to the normal: a regular octagon orthogonal to
 *   the active point normal, with the radius in the point array RadiusArrayName, or Radius;
 * - without a normal, or if its length is 0: an octahedron of that radius.
 *
 * Output is a vtkPolyData of triangles, or a vtkMultiBlockDataSet of these with the structure of
 * the input (since VTK 9.3, a vtkPartitionedDataSetCollection keeps its type). Vertices have
 * "Normals", the id of their isopoint in "vtkOriginalPointIds", and its point arrays except those
 * of its shape. If each drawn point has a vertex cell (VTK_VERTEX, otherwise VTK_POLY_VERTEX),
 * triangles have the id of that cell in "vtkOriginalCellIds", and its cell arrays except those of
 * its shape. Other cells are ignored.
 *
 * Splats do not share vertices. Where corners of several splats coincide, real-valued arrays are
 * averaged, so that colors interpolate as on a mesh. Nearly flat splats have no center vertex.
 *
 * No splat is made for hidden or duplicate ghosts, a position or shape that is not finite, or a
 * radius of 0 or less. Time: O(n log n) in the number of points, unless coordinates are so large
 * that their rounding is coarse compared with the distances between points. After an abort
 * (SetAbortExecute()), or an error, the output is empty. GetErrorCode() is ENOMEM after a lack of
 * memory.
 *
 * @warning
 * Filters that rotate points must also rotate the active normals and the active cell vectors
 * ("SplatAxis"), as vtkTransformFilter does. To mirror or stretch splats, transform the actor.
 *
 * @sa
 * vtkIsopointSplatMapper, vtkScatteredIsopointFilter
 */
#ifndef vtkIsopointSplatPolygons_h
#define vtkIsopointSplatPolygons_h

#include "vtkDataObjectAlgorithm.h"
#include "vtkScatteredIsopointRenderingModule.h" // for the export macro

#include <string> // for private methods

class vtkDataSet;
class vtkPolyData;

class VTKSCATTEREDISOPOINTRENDERING_EXPORT vtkIsopointSplatPolygons : public vtkDataObjectAlgorithm
{
public:
  static vtkIsopointSplatPolygons* New();
  vtkTypeMacro(vtkIsopointSplatPolygons, vtkDataObjectAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The point array of radii: one component, in units of the coordinates. Without it, or if the
   * name is empty, Radius is used. Points with a "SplatPolygon" do not need it. Default: "Radius".
   */
  vtkSetStringMacro(RadiusArrayName);
  vtkGetStringMacro(RadiusArrayName);
  ///@}

  ///@{
  /**
   * The radius of all splats if there is no array of radii, in units of the coordinates. 0: 2 d /
   * sqrt(n) for n points whose bounding box has the diagonal d, which suits points spread over a
   * surface with an area of about d^2. Range: 0 or more. Default: 0.
   */
  vtkSetClampMacro(Radius, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(Radius, double);
  ///@}

  ///@{
  /**
   * Factor on the size of all splats. Range: 0 or more; a negative one gives a warning and counts
   * as 0, which draws nothing. Default: 1.
   */
  virtual void SetRadiusScale(double scale);
  vtkGetMacro(RadiusScale, double);
  ///@}

protected:
  vtkIsopointSplatPolygons();
  ~vtkIsopointSplatPolygons() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestDataObject(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  vtkExecutive* CreateDefaultExecutive() override;

  char* RadiusArrayName;
  double Radius = 0.0;
  double RadiusScale = 1.0;

private:
  vtkIsopointSplatPolygons(const vtkIsopointSplatPolygons&) = delete;
  void operator=(const vtkIsopointSplatPolygons&) = delete;

  /// @returns what to warn of, empty if nothing
  /// @throws isopoint::Aborted, std::bad_alloc
  std::string MakePolygons(vtkDataSet* input, vtkPolyData* output);
};

#endif
