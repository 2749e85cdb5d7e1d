// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class   vtkIsopointSplatPolygons
 * @brief   turns isopoints into the triangles of their splats
 *
 * Each point becomes a splat: a fan of triangles around it, with a normal at each vertex. Together
 * the splats of isopoints are a surface for any mapper, filter, writer or exporter.
 *
 * Input is a data set with points, or composite data of such. The shape of a splat is given by
 * arrays:
 * - the cell arrays "SplatAxis" and "SplatPolygon", as vtkScatteredIsopointFilter writes them, of
 *   the first VTK_VERTEX of the point, and the active normals of the points: up to eight corners,
 *   each with its own height and normal. The arrays may be point arrays, too;
 * - where there is none, or its axis is not orthogonal to the normal, the point array
 *   RadiusArrayName, or Radius, and the active normals: a regular octagon in the plane orthogonal
 *   to the normal, whose corners are a radius away from the point;
 * - where there is no normal, or none of a length: an octahedron of that radius.
 *
 * Output is a vtkPolyData of triangles, or a vtkMultiBlockDataSet of these with the structure of
 * the input (a vtkPartitionedDataSetCollection stays one from VTK 9.3 on). The vertices have the
 * point arrays of their isopoint except for those of its shape, "Normals", and the isopoint's id in
 * "vtkOriginalPointIds". If each drawn point has a vertex cell (VTK_VERTEX, otherwise
 * VTK_POLY_VERTEX), the triangles have the cell arrays of that cell except for those of its shape,
 * and its id in "vtkOriginalCellIds". Cells of other kinds are ignored.
 *
 * Each splat has vertices of its own. Where corners of several are one, real-valued arrays have the
 * mean of their points, so that colors are interpolated as on a mesh. Splats that are nearly flat
 * have no vertex in the middle.
 *
 * No splat is made of points that are hidden or duplicate ghosts, of points whose position or shape
 * is not finite, and of points with a radius of 0 or less. Time: O(n log n) in the number of
 * points, unless coordinates are so large that their rounding is coarse against the distances
 * between points. After an abort (SetAbortExecute()) the output is empty. A lack of memory is an
 * error with an empty output, and GetErrorCode() is ENOMEM.
 *
 * @warning Filters that rotate points have to rotate the active normals and the active vectors of
 * cells ("SplatAxis") with them, as vtkTransformFilter does. Filters that mirror or stretch points
 * distort the splats: do so to the actor instead.
 *
 * @sa vtkIsopointSplatMapper, vtkScatteredIsopointFilter
 */
#ifndef vtkIsopointSplatPolygons_h
#define vtkIsopointSplatPolygons_h

#include "vtkDataObjectAlgorithm.h"
#include "vtkScatteredIsopointRenderingModule.h" // for the export macro

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
   * Name of the point array of radii: one component, in the units of the points' coordinates. If
   * the input has no such array, or the name is empty, Radius is used. Points with polygons of
   * their own do not need it. Default: "Radius".
   */
  vtkSetStringMacro(RadiusArrayName);
  vtkGetStringMacro(RadiusArrayName);
  ///@}

  ///@{
  /**
   * Radius of all splats of input without an array of radii, in the units of the points'
   * coordinates. 0: twice the diagonal of the bounding box, divided by the square root of the
   * number of points, which suits points spread over a surface of the diagonal's square. Range: 0
   * or more. Default: 0.
   */
  vtkSetClampMacro(Radius, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(Radius, double);
  ///@}

  ///@{
  /**
   * Factor on the size of all splats, without unit. Range: 0 or more. Default: 1.
   */
  vtkSetClampMacro(RadiusScale, double, 0.0, VTK_DOUBLE_MAX);
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

  /// @throws isopoint::Aborted, std::bad_alloc
  void MakePolygons(vtkDataSet* input, vtkPolyData* output);
};

#endif
