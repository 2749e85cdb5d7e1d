// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointTracedBlocks_h
#define vtkIsopointTracedBlocks_h

#include <array>
#include <vector>

class vtkMapper;
class vtkPolyData;

/// A polydata with points, and its display attributes in a composite.
struct vtkIsopointTracedBlock
{
  vtkPolyData* Data = nullptr;
  bool Visible = true;
  bool HasColor = false; // replaces scalar colors and the material's color
  std::array<double, 3> Color = { 0.0, 0.0, 0.0 };
};

/// The input of a mapper, or the leaves of its composite input. A leaf has the visibility and color
/// of the innermost block around it that has any.
std::vector<vtkIsopointTracedBlock> vtkIsopointTracedBlocks(vtkMapper* mapper);

#endif
