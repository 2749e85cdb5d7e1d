// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkIsopointSplatBuffers.h"

#include "vtkIsopointSplatBounds.h"
#include "vtkIsopointSplatOpenGL.h"
#include "vtkIsopointSplatSubset.h"

#include "vtkBoundingBox.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkMath.h"
#include "vtkOpenGLBufferObject.h"
#include "vtkOpenGLVertexArrayObject.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSMPTools.h"
#include "vtkShaderProgram.h"
#include "vtkUnsignedCharArray.h"

#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace
{

using Disk = vtkIsopointSplatSubset::Splat;

bool isFinite(const double* vector)
{
  return std::isfinite(vector[0]) && std::isfinite(vector[1]) && std::isfinite(vector[2]);
}

std::array<double, 3> centerOf(vtkPoints* points)
{
  const vtkBoundingBox box = vtkIsopointSplatBounds::OfFinite(points);
  std::array<double, 3> center = { 0.0, 0.0, 0.0 };
  for (int axis = 0; axis < 3 && box.IsValid(); ++axis)
  {
    center[axis] = 0.5 * box.GetBound(2 * axis) + 0.5 * box.GetBound(2 * axis + 1);
  }
  return center;
}

/// Three components as floats; zeros where they are not finite.
void copyVector(vtkDataArray* array, vtkIdType index, float* vector)
{
  double values[3];
  array->GetTuple(index, values);
  const bool isUsable = isFinite(values);
  for (int axis = 0; axis < 3; ++axis)
  {
    vector[axis] = isUsable ? static_cast<float>(values[axis]) : 0.0f;
  }
}

/// Three components as floats, normalized; zeros where the length is 0 or not finite.
void copyUnitVector(vtkDataArray* array, vtkIdType index, float* vector)
{
  double values[3];
  array->GetTuple(index, values);
  const double length = std::hypot(values[0], values[1], values[2]);
  const bool isUsable = std::isfinite(length) && length > 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    vector[axis] = isUsable ? static_cast<float>(values[axis] / length) : 0.0f;
  }
}

struct Clip
{
  std::array<float, 4> Plane{};
  float Turn = 0.0f; // 1: the face across the crease is on the normal's side, -1: on the other
};

/// A splat's clipping plane: its normal divided by the radius, and the center's distance from it in
/// radii. Zeros for none, and for one that is out of the range of single precision.
std::array<float, 4> planeOf(const double* clip, double radius)
{
  const double scale = std::hypot(clip[0], clip[1], clip[2]) * radius;
  std::array<float, 4> plane{};
  for (std::size_t i = 0; i < plane.size() && scale > 0.0; ++i)
  {
    const double value = clip[i] / scale;
    if (!(std::abs(value) <= std::numeric_limits<float>::max()))
    {
      return {};
    }
    plane[i] = static_cast<float>(value);
  }
  return plane;
}

/// Uploads elements. Where OpenGL has no memory for them, the buffer has another size than theirs.
/// @throws std::bad_alloc
template <class TElement>
void upload(vtkOpenGLBufferObject* buffer, const TElement* elements, std::size_t count,
  vtkOpenGLBufferObject::ObjectType type = vtkOpenGLBufferObject::ArrayBuffer)
{
  if (count == 0)
  {
    return;
  }
  buffer->Upload(elements, count, type);
  const bool isArray = type == vtkOpenGLBufferObject::ArrayBuffer;
  GLint64 size = 0;
  buffer->Bind();
  glGetBufferParameteri64v(
    isArray ? GL_ARRAY_BUFFER : GL_ELEMENT_ARRAY_BUFFER, GL_BUFFER_SIZE, &size);
  if (static_cast<std::size_t>(size) != count * sizeof(TElement))
  {
    vtkIsopointSplatOutOfGraphicsMemory();
  }
}

/// What was uploaded.
template <class TElement>
std::vector<TElement> download(vtkOpenGLBufferObject* buffer, std::size_t count)
{
  std::vector<TElement> elements(count);
  buffer->Bind();
  glGetBufferSubData(
    GL_ARRAY_BUFFER, 0, static_cast<GLsizeiptr>(count * sizeof(TElement)), elements.data());
  return elements;
}

} // namespace

struct vtkIsopointSplatBuffers::Program
{
  vtkNew<vtkOpenGLVertexArrayObject> VertexArray;
};

//------------------------------------------------------------------------------
vtkIsopointSplatBuffers::vtkIsopointSplatBuffers() = default;
vtkIsopointSplatBuffers::~vtkIsopointSplatBuffers() = default;

//------------------------------------------------------------------------------
void vtkIsopointSplatBuffers::SetSplats(vtkPolyData* polyData, const Shape& shape)
{
  vtkPoints* const points = polyData->GetPoints();
  vtkUnsignedCharArray* ghosts = polyData->GetPointGhostArray();
  if (ghosts && ghosts->GetNumberOfTuples() < points->GetNumberOfPoints())
  {
    ghosts = nullptr;
  }
  this->NumberOfSplats = points->GetNumberOfPoints();
  this->Center = centerOf(points);
  this->Normals = shape.Normals != nullptr;
  this->Ellipses = shape.Axis1 != nullptr && shape.Axis2 != nullptr;

  std::vector<Disk> disks(static_cast<std::size_t>(this->NumberOfSplats));
  std::vector<float> axes(this->Ellipses ? 6 * disks.size() : 0);
  vtkSMPTools::For(0, this->NumberOfSplats,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType i = begin; i < end; ++i)
      {
        double position[3];
        points->GetPoint(i, position);
        Disk& disk = disks[i];
        double radius = shape.Radius;
        if (shape.Radii)
        {
          shape.Radii->GetTuple(i, &radius);
        }
        const int ghost = ghosts ? ghosts->GetValue(i) : 0;
        const bool isDrawn = isFinite(position) && radius > 0.0 && std::isfinite(radius) &&
                             (ghost & vtkDataSetAttributes::HIDDENPOINT) == 0;
        const double side = (ghost & vtkDataSetAttributes::DUPLICATEPOINT) == 0 ? 1.0 : -1.0;
        for (int axis = 0; axis < 3; ++axis)
        {
          disk.Position[axis] =
            isDrawn ? static_cast<float>(position[axis] - this->Center[axis]) : 0.0f;
          disk.Normal[axis] = 0.0f;
        }
        disk.Radius = isDrawn ? static_cast<float>(side * radius) : 0.0f;
        if (shape.Normals)
        {
          copyUnitVector(shape.Normals, i, disk.Normal);
        }
        if (this->Ellipses)
        {
          copyVector(shape.Axis1, i, &axes[6 * i]);
          copyVector(shape.Axis2, i, &axes[6 * i + 3]);
        }
      }
    });
  upload(this->Disks, disks.data(), disks.size());
  if (this->Ellipses)
  {
    upload(this->Axes, axes.data(), axes.size());
  }
  this->SetClips(shape);
  this->SubsetStride = 0;
  this->ForgetPrograms();
}

//------------------------------------------------------------------------------
void vtkIsopointSplatBuffers::SetClips(const Shape& shape)
{
  this->Clipped = false;
  if (!shape.Clips)
  {
    return;
  }
  std::vector<Clip> clips(static_cast<std::size_t>(this->NumberOfSplats));
  std::atomic<bool> hasClip{ false };
  vtkSMPTools::For(0, this->NumberOfSplats,
    [&](vtkIdType begin, vtkIdType end)
    {
      bool hasOne = false;
      for (vtkIdType i = begin; i < end; ++i)
      {
        double clip[5] = {};
        double radius = shape.Radius;
        shape.Clips->GetTuple(i, clip);
        if (shape.Radii)
        {
          shape.Radii->GetTuple(i, &radius);
        }
        clips[i] = { planeOf(clip, radius), clip[4] > 0.0 ? 1.0f : -1.0f };
        hasOne = hasOne || clips[i].Plane != std::array<float, 4>{};
      }
      if (hasOne)
      {
        hasClip = true;
      }
    });
  this->Clipped = hasClip;
  if (this->Clipped)
  {
    upload(this->Clips, clips.data(), clips.size());
  }
}

//------------------------------------------------------------------------------
void vtkIsopointSplatBuffers::SetColors(vtkUnsignedCharArray* colors)
{
  this->ColorComponents = colors ? 4 : 0;
  if (colors)
  {
    upload(this->Colors, colors->GetPointer(0),
      4 * static_cast<std::size_t>(colors->GetNumberOfTuples()));
  }
  this->ForgetPrograms();
}

//------------------------------------------------------------------------------
void vtkIsopointSplatBuffers::SetColorCoordinates(vtkDataArray* coordinates)
{
  std::vector<float> values(2 * static_cast<std::size_t>(coordinates->GetNumberOfTuples()));
  vtkSMPTools::For(0, coordinates->GetNumberOfTuples(),
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType i = begin; i < end; ++i)
      {
        double tuple[2];
        coordinates->GetTuple(i, tuple);
        // Beyond its ends the map would be blended with its border.
        values[2 * i] = static_cast<float>(vtkMath::ClampValue(tuple[0], 0.0, 1.0));
        values[2 * i + 1] = static_cast<float>(vtkMath::ClampValue(tuple[1], 0.0, 1.0));
      }
    });
  upload(this->Colors, values.data(), values.size());
  this->ColorComponents = 2;
  this->ForgetPrograms();
}

//------------------------------------------------------------------------------
void vtkIsopointSplatBuffers::Draw(vtkShaderProgram* program)
{
  if (this->NumberOfSplats == 0)
  {
    return;
  }
  this->Bind(program);
  if (this->Stride > 1)
  {
    this->Subset->Bind();
    glDrawElements(GL_POINTS, static_cast<GLsizei>(this->SubsetSize), GL_UNSIGNED_INT, nullptr);
    this->Subset->Release();
  }
  else
  {
    glDrawArrays(GL_POINTS, 0, static_cast<GLsizei>(this->NumberOfSplats));
  }
  glBindVertexArray(0);
}

//------------------------------------------------------------------------------
void vtkIsopointSplatBuffers::Bind(vtkShaderProgram* program)
{
  std::unique_ptr<Program>& entry = this->Programs[program->GetHandle()];
  if (entry)
  {
    entry->VertexArray->Bind();
    return;
  }
  entry = std::make_unique<Program>();
  vtkOpenGLVertexArrayObject* const vertexArray = entry->VertexArray;
  vertexArray->Bind();
  const auto add = [&](vtkOpenGLBufferObject* buffer, const char* name, std::size_t offset,
                     std::size_t stride, int type, int components)
  {
    if (program->IsAttributeUsed(name))
    {
      vertexArray->AddAttributeArray(program, buffer, name, static_cast<int>(offset), stride, type,
        components, type == VTK_UNSIGNED_CHAR);
    }
  };
  add(this->Disks, "centerMC", offsetof(Disk, Position), sizeof(Disk), VTK_FLOAT, 3);
  add(this->Disks, "normalMC", offsetof(Disk, Normal), sizeof(Disk), VTK_FLOAT, 3);
  add(this->Disks, "radius", offsetof(Disk, Radius), sizeof(Disk), VTK_FLOAT, 1);
  if (this->SubsetStride > 1)
  {
    add(this->Growth, "growth", 0, sizeof(float), VTK_FLOAT, 1);
  }
  if (this->Ellipses)
  {
    constexpr std::size_t vectorSize = 3 * sizeof(float);
    add(this->Axes, "axis1MC", 0, 2 * vectorSize, VTK_FLOAT, 3);
    add(this->Axes, "axis2MC", vectorSize, 2 * vectorSize, VTK_FLOAT, 3);
  }
  if (this->Clipped)
  {
    add(this->Clips, "clipMC", offsetof(Clip, Plane), sizeof(Clip), VTK_FLOAT, 4);
    add(this->Clips, "clipTurn", offsetof(Clip, Turn), sizeof(Clip), VTK_FLOAT, 1);
  }
  if (this->ColorComponents == 4)
  {
    add(this->Colors, "color", 0, 4, VTK_UNSIGNED_CHAR, 4);
  }
  else if (this->ColorComponents == 2)
  {
    add(this->Colors, "color", 0, 2 * sizeof(float), VTK_FLOAT, 2);
  }
}

//------------------------------------------------------------------------------
void vtkIsopointSplatBuffers::SetStride(int stride)
{
  if (stride > 1 && this->SubsetStride != stride && this->NumberOfSplats > 0)
  {
    const auto count = static_cast<std::size_t>(this->NumberOfSplats);
    const std::vector<Disk> disks = download<Disk>(this->Disks, count);
    const std::vector<float> axes =
      this->Ellipses ? download<float>(this->Axes, 6 * count) : std::vector<float>();
    const vtkIsopointSplatSubset subset(
      disks.data(), this->Ellipses ? axes.data() : nullptr, count, stride);
    const std::vector<std::uint32_t>& indices = subset.GetIndices();
    glBindVertexArray(0); // a vertex array would keep the binding of the indices
    upload(this->Subset, indices.data(), indices.size(), vtkOpenGLBufferObject::ElementArrayBuffer);
    upload(this->Growth, subset.GetGrowth().data(), count);
    this->SubsetSize = static_cast<vtkIdType>(indices.size());
    this->SubsetStride = stride;
    this->ForgetPrograms();
  }
  this->Stride = stride;
}

//------------------------------------------------------------------------------
void vtkIsopointSplatBuffers::ForgetPrograms()
{
  this->Programs.clear();
}

//------------------------------------------------------------------------------
void vtkIsopointSplatBuffers::ReleaseGraphicsResources()
{
  for (auto& entry : this->Programs)
  {
    entry.second->VertexArray->ReleaseGraphicsResources();
  }
  this->ForgetPrograms();
  this->Disks->ReleaseGraphicsResources();
  this->Axes->ReleaseGraphicsResources();
  this->Clips->ReleaseGraphicsResources();
  this->Colors->ReleaseGraphicsResources();
  this->Growth->ReleaseGraphicsResources();
  this->Subset->ReleaseGraphicsResources();
  this->SubsetStride = 0;
}
