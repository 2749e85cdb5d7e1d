// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class   vtkScatteredBodyFilter
 * @brief   find the closed surface of scattered samples, such as particles
 *
 * vtkScatteredBodyFilter generates the surface of the body of all samples, from their positions
 * alone: neither an array nor a radius is needed. The body is the union of the tetrahedra of the
 * samples' Delaunay tetrahedralization that are not in gaps; docs/triangles.md in the source
 * distribution defines it. With DropGapsOff() it is the convex hull. The surface is that of
 * vtkScatteredIsosurfaceFilter with CappingOn() and an isovalue of minus infinity.
 *
 * The output is a vtkPolyData of triangles between samples, which have all arrays of the sample:
 * each edge has two triangles, each point one fan, and right-hand normals point outwards. The
 * surface of a hole within the body is a connected component with a negative volume. Samples in one
 * plane, or fewer than four, have no body. The surface passes through the outermost samples. So the
 * volume is less than that of particles which extend beyond their centers: by 7 % for 4,000
 * particles, by two thirds for 19.
 *
 * Samples are the points of the input, the centers of its cells if it has arrays of cells only, or
 * the leaves of hyper tree grids, of all blocks. Those whose position is not finite, ghosts and
 * hidden samples are skipped. The guarantees on threads, ranks, order and the kept tree are those
 * of vtkScatteredIsosurfaceFilter. Global ids are left out and, with a message, arrays that not all
 * blocks have.
 *
 * @sa
 * vtkScatteredIsosurfaceFilter vtkConnectivityFilter vtkMassProperties vtkDelaunay3D
 */

#ifndef vtkScatteredBodyFilter_h
#define vtkScatteredBodyFilter_h

#include "vtkScatteredIsopointFiltersModule.h" // for the export macro
#include "vtkScatteredSurfaceFilter.h"

#include <memory> // for std::unique_ptr

class vtkIsopointSlicing;

class VTKSCATTEREDISOPOINTFILTERS_EXPORT vtkScatteredBodyFilter : public vtkScatteredSurfaceFilter
{
public:
  static vtkScatteredBodyFilter* New();
  vtkTypeMacro(vtkScatteredBodyFilter, vtkScatteredSurfaceFilter);

  ///@{
  /**
   * The least area of a connected component, as a share of the area of the largest one. Smaller
   * ones, such as droplets, are left out; holes within others stay. From 0, for none, to 1.
   * Default: 0.
   */
  virtual void SetMinimumPieceSize(double share);
  virtual double GetMinimumPieceSize();
  ///@}

protected:
  vtkScatteredBodyFilter();
  ~vtkScatteredBodyFilter() override;

  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkScatteredBodyFilter(const vtkScatteredBodyFilter&) = delete;
  void operator=(const vtkScatteredBodyFilter&) = delete;

  const isopoint::Report& GetReport() const override;

  const std::unique_ptr<vtkIsopointSlicing> Slicing; // by a function that is the same everywhere
};

#endif
