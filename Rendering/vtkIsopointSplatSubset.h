// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointSplatSubset_h
#define vtkIsopointSplatSubset_h

#include <cstddef>
#include <cstdint>
#include <vector>

/**
 * A choice of splats for a lower level of detail, grown so far that they cover all others.
 *
 * Splats are put in the order of a curve that fills space (Morton's) and divided into runs. In each
 * run the splat in the middle grows until its plane covers the rest; what faces another way, or
 * lies too far off, gets a splat of its own, as the two sides of a thin wall do.
 */
class vtkIsopointSplatSubset
{
public:
  struct Splat
  {
    float Position[3];
    float Normal[3]; // unit vector, or 0 for none
    float Radius;    // not positive: not drawn, and not chosen
  };

  /// Chooses about one splat in stride, and at most that number times mostOfRun.
  /// @param axes two half-axes of each splat, of three components each; null for disks
  /// @param count fewer than 2^32
  /// @throws std::bad_alloc
  /// O(count log(count)) with the threads of vtkSMPTools
  vtkIsopointSplatSubset(const Splat* splats, const float* axes, std::size_t count, int stride);

  static constexpr int mostOfRun = 4;

  /// Of the chosen splats.
  const std::vector<std::uint32_t>& GetIndices() const { return this->Indices; }

  /// Factor on the radius and the half-axes of each splat, chosen or not: at least 1.
  const std::vector<float>& GetGrowth() const { return this->Growth; }

private:
  class Run;

  std::vector<std::uint32_t> Indices;
  std::vector<float> Growth;
};

#endif
// VTK-HeaderTest-Exclude: vtkIsopointSplatSubset.h
