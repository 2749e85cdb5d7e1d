// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class   vtkIsopointSplatRepresentation
 * @brief   renders points with normals as one lit surface
 *
 * ParaView's representation "Isopoint Splats": its surface representation with
 * vtkIsopointSplatPolygons instead of the filter that extracts surfaces. Selections hold the
 * input's points and cells whose splats are visible. Without normals, points are drawn as octahedra
 * if there is a Radius; otherwise there is a warning.
 *
 * @sa
 * vtkIsopointSplatPolygons, vtkIsopointPolygonMapper
 */
#ifndef vtkIsopointSplatRepresentation_h
#define vtkIsopointSplatRepresentation_h

#include "vtkGeometryRepresentationWithFaces.h"
#include "vtkScatteredIsopointRepresentationsModule.h" // for the export macro

class vtkIsopointSplatPolygons;

class VTKSCATTEREDISOPOINTREPRESENTATIONS_EXPORT vtkIsopointSplatRepresentation
  : public vtkGeometryRepresentationWithFaces
{
public:
  static vtkIsopointSplatRepresentation* New();
  vtkTypeMacro(vtkIsopointSplatRepresentation, vtkGeometryRepresentationWithFaces);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The shape of splats; see vtkIsopointSplatPolygons. Defaults: "Radius", 0, 1.
   */
  void SetRadiusArrayName(const char* name);
  void SetRadius(double radius);
  void SetRadiusScale(double scale);
  ///@}

protected:
  vtkIsopointSplatRepresentation();
  ~vtkIsopointSplatRepresentation() override = default;

  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkIsopointSplatRepresentation(const vtkIsopointSplatRepresentation&) = delete;
  void operator=(const vtkIsopointSplatRepresentation&) = delete;

  vtkIsopointSplatPolygons* Polygons; // the superclass's geometry filter
};

#endif
