// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointTracedBlocks_h
#define vtkIsopointTracedBlocks_h

#include <array>
#include <vector>

class vtkMapper;
class vtkPolyData;

/// A polydata with points, and how a mapper of composite data displays it.
struct vtkIsopointTracedBlock
{
  vtkPolyData* Data = nullptr;
  bool Visible = true;
  bool HasColor = false; // instead of scalar colors and the material's color
  std::array<double, 3> Color = { 0.0, 0.0, 0.0 };
};

/// The input of a mapper, or the leaves of its composite input. Their visibilities and colors are
/// those of the innermost block around them that has any.
std::vector<vtkIsopointTracedBlock> vtkIsopointTracedBlocks(vtkMapper* mapper);

#endif
