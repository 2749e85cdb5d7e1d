// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointSplatBuffers_h
#define vtkIsopointSplatBuffers_h

#include "vtkNew.h"
#include "vtkType.h"

#include <array>
#include <map>
#include <memory>
#include <vector>

class vtkDataArray;
class vtkOpenGLBufferObject;
class vtkOpenGLVertexArrayObject;
class vtkPolyData;
class vtkShaderProgram;
class vtkUnsignedCharArray;

/**
 * The splats of one vtkPolyData in buffers of the graphics card, ready for every pass.
 *
 * Positions are kept relative to a centre, which the caller's matrices add in double precision, so
 * that points around 1e9 do not tremble.
 */
class vtkIsopointSplatBuffers
{
public:
  vtkIsopointSplatBuffers();
  ~vtkIsopointSplatBuffers();
  vtkIsopointSplatBuffers(const vtkIsopointSplatBuffers&) = delete;
  vtkIsopointSplatBuffers& operator=(const vtkIsopointSplatBuffers&) = delete;

  /// Arrays that shape the splats, one tuple a point; null where there is none.
  struct Shape
  {
    vtkDataArray* Normals = nullptr; // of 3 components
    vtkDataArray* Radii = nullptr;   // of 1 component
    vtkDataArray* Axis1 = nullptr;   // of 3 components, both axes or none
    vtkDataArray* Axis2 = nullptr;
    vtkDataArray* Clips = nullptr; // of 4 or 5: a plane relative to the point, what is beyond
    double Radius = 1.0;           // of all splats where Radii is null
  };

  /// Takes the points of a polydata of at most 2^31 - 1 points. Splats of a radius that is not
  /// positive, of a position that is not finite, and hidden or duplicated ghost points are not
  /// drawn. Of a splat at q with a plane only the places p with (a, b, c) . (p - q) + d >= 0 are
  /// drawn.
  void SetSplats(vtkPolyData* polyData, const Shape& shape);

  /// One color of 4 components a point; null for none.
  void SetColors(vtkUnsignedCharArray* colors);

  /// Coordinates of 2 components in a color map, one a point.
  void SetColorCoordinates(vtkDataArray* coordinates);

  /// From now on about one splat in so many is drawn, always the same ones. After SetSplats.
  void SetStride(int stride);

  /// Draws the splats with a program that is in use.
  void Draw(vtkShaderProgram* program);

  void ReleaseGraphicsResources();

  /// The point that positions are relative to.
  const std::array<double, 3>& GetCenter() const { return this->Center; }
  vtkIdType GetNumberOfSplats() const { return this->NumberOfSplats; }
  bool HasNormals() const { return this->Normals; }
  bool HasEllipses() const { return this->Ellipses; }
  bool HasClips() const { return this->Clipped; }
  bool HasColors() const { return this->ColorComponents > 0; }

private:
  struct Program;

  void SetClips(const Shape& shape);
  void Bind(vtkShaderProgram* program);
  void ForgetPrograms();

  vtkNew<vtkOpenGLBufferObject> Disks; // position, normal, radius
  vtkNew<vtkOpenGLBufferObject> Axes;
  vtkNew<vtkOpenGLBufferObject> Clips;
  vtkNew<vtkOpenGLBufferObject> Colors;
  vtkNew<vtkOpenGLBufferObject> Subset; // indices of a random part of the splats
  std::map<unsigned int, std::unique_ptr<Program>> Programs; // by the program's handle
  std::array<double, 3> Center = { 0.0, 0.0, 0.0 };
  vtkIdType NumberOfSplats = 0;
  vtkIdType SubsetSize = 0;
  int Stride = 1;
  int SubsetStride = 0;    // that the subset was made for; 0: none
  int ColorComponents = 0; // 4: colors, 2: coordinates in a color map
  bool Normals = false;
  bool Ellipses = false;
  bool Clipped = false;
};

#endif
// VTK-HeaderTest-Exclude: vtkIsopointSplatBuffers.h
