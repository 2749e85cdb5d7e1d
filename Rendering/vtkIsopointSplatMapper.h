// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class   vtkIsopointSplatMapper
 * @brief   draws isopoints as one lit surface
 *
 * Input is a data set with points, or a composite of such (SetInputDataObject or
 * SetInputConnection). vtkIsopointSplatPolygons turns the points into triangles with normals, and
 * VTK's own mapper draws these. Coloring, opacity, depth peeling, clipping planes, physically based
 * rendering, render passes, multisampling and exporters work as for a mesh. The triangles are the
 * mapper's input: GetInput() and pickers that intersect rays refer to them, and to their points by
 * the array "vtkOriginalPointIds".
 *
 * A hardware selection (vtkHardwareSelector) of points finds the points whose splats are visible; a
 * selection of cells finds the vertex cells of these points.
 *
 * Colors and visibilities of blocks are set by SetCompositeDataDisplayAttributes(), for the blocks
 * of GetPolygons()->GetOutputDataObject(0).
 *
 * @sa
 * vtkIsopointSplatPolygons, vtkPointGaussianMapper
 */
#ifndef vtkIsopointSplatMapper_h
#define vtkIsopointSplatMapper_h

#include "vtkIsopointPolygonMapper.h"
#include "vtkIsopointSplatPolygons.h"            // for the shape of splats
#include "vtkNew.h"                              // for vtkNew
#include "vtkScatteredIsopointRenderingModule.h" // for the export macro

class VTKSCATTEREDISOPOINTRENDERING_EXPORT vtkIsopointSplatMapper : public vtkIsopointPolygonMapper
{
public:
  static vtkIsopointSplatMapper* New();
  vtkTypeMacro(vtkIsopointSplatMapper, vtkIsopointPolygonMapper);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The shape of splats; see vtkIsopointSplatPolygons. Defaults: "Radius", 0, 1.
   */
  void SetRadiusArrayName(const char* name) { this->Polygons->SetRadiusArrayName(name); }
  const char* GetRadiusArrayName() { return this->Polygons->GetRadiusArrayName(); }
  void SetRadius(double radius) { this->Polygons->SetRadius(radius); }
  double GetRadius() { return this->Polygons->GetRadius(); }
  void SetRadiusScale(double scale) { this->Polygons->SetRadiusScale(scale); }
  double GetRadiusScale() { return this->Polygons->GetRadiusScale(); }
  ///@}

  /**
   * The filter that makes the triangles.
   */
  vtkIsopointSplatPolygons* GetPolygons() { return this->Polygons; }

  using vtkIsopointPolygonMapper::SetInputConnection;
  void SetInputConnection(int port, vtkAlgorithmOutput* input) override;
  void ShallowCopy(vtkAbstractMapper* mapper) override;
  vtkMTimeType GetMTime() override;

protected:
  vtkIsopointSplatMapper() = default;
  ~vtkIsopointSplatMapper() override = default;

private:
  vtkIsopointSplatMapper(const vtkIsopointSplatMapper&) = delete;
  void operator=(const vtkIsopointSplatMapper&) = delete;

  const vtkNew<vtkIsopointSplatPolygons> Polygons;
};

#endif
