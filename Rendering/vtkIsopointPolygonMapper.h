// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class   vtkIsopointPolygonMapper
 * @brief   draws the triangles of splats, and selects points by their splats
 *
 * VTK's mapper for vtkPolyData and composite data, with one difference: a hardware selection of
 * points finds the points whose splats are visible. VTK's own mappers find points where their
 * vertices are drawn, even through surfaces in front of them. The input comes from
 * vtkIsopointSplatPolygons, whose ids of points and cells are used in selections.
 *
 * @sa
 * vtkIsopointSplatMapper
 */
#ifndef vtkIsopointPolygonMapper_h
#define vtkIsopointPolygonMapper_h

#include "vtkIsopointCompositeMapper.h"
#include "vtkScatteredIsopointRenderingModule.h" // for the export macro

class VTKSCATTEREDISOPOINTRENDERING_EXPORT vtkIsopointPolygonMapper
  : public vtkIsopointCompositeMapper
{
public:
  static vtkIsopointPolygonMapper* New();
  vtkTypeMacro(vtkIsopointPolygonMapper, vtkIsopointCompositeMapper);

  void Render(vtkRenderer* renderer, vtkActor* actor) override;

protected:
  vtkIsopointPolygonMapper();
  ~vtkIsopointPolygonMapper() override = default;

private:
  vtkIsopointPolygonMapper(const vtkIsopointPolygonMapper&) = delete;
  void operator=(const vtkIsopointPolygonMapper&) = delete;
};

#endif
