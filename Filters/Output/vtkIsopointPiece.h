// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointPiece_h
#define vtkIsopointPiece_h

class vtkDataObject;

/**
 * Reduces an output to one of several pieces: of points, the share of them that is its turn; of
 * triangles, the share of them with the points that they use. All pieces together have each vertex
 * or triangle once, in their order. Points that triangles of several pieces use are in all of
 * these.
 * @param output a vtkPolyData with cells of one kind, or a composite, whose leaves are reduced
 * @param piece 0 .. pieces - 1; others are empty
 * @throws std::bad_alloc
 */
void vtkTakeIsopointPiece(int piece, int pieces, vtkDataObject* output);

#endif
