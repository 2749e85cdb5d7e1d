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
 * The splats of one vtkPolyData in buffers of the graphics card, for all passes.
 *
 * Positions are relative to a center, which the caller's matrices add in double precision: single
 * precision would not resolve coordinates around 1e9. Methods that fill buffers throw
 * std::bad_alloc where memory runs out, of the program or of OpenGL; ReleaseGraphicsResources is
 * then to be called.
 */
class vtkIsopointSplatBuffers
{
public:
  vtkIsopointSplatBuffers();
  ~vtkIsopointSplatBuffers();
  vtkIsopointSplatBuffers(const vtkIsopointSplatBuffers&) = delete;
  vtkIsopointSplatBuffers& operator=(const vtkIsopointSplatBuffers&) = delete;

  /// Arrays of the splats' shapes with one tuple per point; null where there is none.
  struct Shape
  {
    vtkDataArray* Normals = nullptr; // of 3 components
    vtkDataArray* Radii = nullptr;   // of 1 component
    vtkDataArray* Axis1 = nullptr;   // of 3 components; used only if there are both axes
    vtkDataArray* Axis2 = nullptr;
    vtkDataArray* Clips = nullptr; // of 4 or 5, see vtkIsopointSplatMapper::SetSplatClipArrayName
    double Radius = 1.0;           // of all splats where Radii is null
  };

  /// Sets the splats from a polydata of at most 2^31 - 1 points. Points whose radius is not
  /// positive or whose position is not finite, and hidden points are not drawn. Duplicated points
  /// have splats of negative radius.
  void SetSplats(vtkPolyData* polyData, const Shape& shape);

  /// Sets colors of 4 components, one per point; null for none.
  void SetColors(vtkUnsignedCharArray* colors);

  /// Sets coordinates of 2 components in a color map, one per point.
  void SetColorCoordinates(vtkDataArray* coordinates);

  /// Selects about one splat in this number to be drawn, always the same ones, grown as
  /// vtkIsopointSplatSubset describes. To be called after SetSplats.
  void SetStride(int stride);

  /// Draws the selected splats with a program that is in use.
  void Draw(vtkShaderProgram* program);

  void ReleaseGraphicsResources();

  /// The center, in the coordinates of the points.
  const std::array<double, 3>& GetCenter() const { return this->Center; }
  vtkIdType GetNumberOfSplats() const { return this->NumberOfSplats; }
  bool HasNormals() const { return this->Normals; }
  bool HasEllipses() const { return this->Ellipses; }
  bool HasClips() const { return this->Clipped; }
  bool HasGrowth() const { return this->Stride > 1; }
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
  vtkNew<vtkOpenGLBufferObject> Growth; // factors on the selected splats' sizes
  vtkNew<vtkOpenGLBufferObject> Subset; // indices of the selected splats
  std::map<unsigned int, std::unique_ptr<Program>> Programs; // by the program's handle
  std::array<double, 3> Center = { 0.0, 0.0, 0.0 };
  vtkIdType NumberOfSplats = 0;
  vtkIdType SubsetSize = 0;
  int Stride = 1;
  int SubsetStride = 0;    // stride of the indices in Subset; 0: none
  int ColorComponents = 0; // 4: colors, 2: coordinates in a color map
  bool Normals = false;
  bool Ellipses = false;
  bool Clipped = false;
};

#endif
// VTK-HeaderTest-Exclude: vtkIsopointSplatBuffers.h
