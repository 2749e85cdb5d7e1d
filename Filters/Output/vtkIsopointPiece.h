// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointPiece_h
#define vtkIsopointPiece_h

class vtkDataObject;

/// Reduces an output to one of several pieces: a range of the points, or a range of the triangles
/// with the points that they use. The pieces together have each vertex or triangle once, in their
/// order; points shared by triangles of several pieces are in all of these.
/// @param output a vtkPolyData with cells of one kind, or a composite, whose leaves are reduced
/// @param piece 0 .. pieces - 1; other pieces are empty
/// @throws std::bad_alloc
void vtkTakeIsopointPiece(int piece, int pieces, vtkDataObject* output);

#endif
