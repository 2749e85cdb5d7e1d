// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Tree/MedianSelection.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace isopoint
{

/// Pointers to samples. Room is made for many at a time, so that adding one needs no branch.
template <class TSample>
class SampleList
{
public:
  /// Where to write up to `count` further pointers; resize() then sets how many there are.
  TSample** makeRoom(std::size_t count)
  {
    if (this->Samples.size() < this->Count + count)
    {
      this->Samples.resize(2 * this->Count + count);
    }
    return this->Samples.data() + this->Count;
  }

  void resize(std::size_t count) { this->Count = count; }
  std::size_t size() const { return this->Count; }
  TSample** begin() { return this->Samples.data(); }
  TSample** end() { return this->Samples.data() + this->Count; }
  TSample* const* begin() const { return this->Samples.data(); }
  TSample* const* end() const { return this->Samples.data() + this->Count; }

private:
  std::vector<TSample*> Samples;
  std::size_t Count = 0;
};

/// Samples that may be in the wrong half after a separation.
template <class TSample>
struct AmbiguousSamples
{
  SampleList<TSample> lower; // in the lower half
  SampleList<TSample> upper;

  void clear()
  {
    this->lower.resize(0);
    this->upper.resize(0);
  }

  void add(const AmbiguousSamples& other)
  {
    const auto append = [](SampleList<TSample>& list, const SampleList<TSample>& more)
    {
      std::copy(more.begin(), more.end(), list.makeRoom(more.size()));
      list.resize(list.size() + more.size());
    };
    append(this->lower, other.lower);
    append(this->upper, other.upper);
  }
};

/// Scans a part of one half of a node's samples in blocks. Misplaced samples are listed without
/// branches on comparisons [EW16], which are unpredictable at a median split.
template <class TSample>
class HalfScan
{
public:
  HalfScan(TSample* begin, TSample* end)
    : Block(begin)
    , Unscanned(begin)
    , End(end)
  {
  }

  /// Lists the next misplaced samples if the list is empty. @returns whether any are listed
  template <class Misplaced>
  bool list(const Misplaced& isMisplaced)
  {
    return this->listBlocks(
      [&](std::ptrdiff_t length)
      {
        const TSample* const block = this->Block;
        std::size_t count = 0;
        for (std::ptrdiff_t i = 0; i < length; ++i)
        {
          this->Offsets[count] = static_cast<std::uint8_t>(i);
          count += isMisplaced(block[i]) ? 1 : 0;
        }
        this->Count = count;
      });
  }

  /// Lists the next misplaced samples, if none is listed, where some may belong in either half.
  /// @param isHere(sample) whether it belongs in this half
  /// @param isThere(sample) whether it belongs in the other half
  /// @param open receives the samples that may belong in either
  /// @returns whether any are listed
  template <class Here, class There>
  bool list(const Here& isHere, const There& isThere, SampleList<TSample>& open)
  {
    return this->listBlocks(
      [&](std::ptrdiff_t length) { this->scan(length, isHere, isThere, open); });
  }

  /// Swaps as many samples as both lists have.
  void swapListed(HalfScan& other)
  {
    const std::size_t pairs = std::min(this->count(), other.count());
    for (std::size_t i = 0; i < pairs; ++i)
    {
      std::swap((*this)[i], other[i]);
    }
    this->drop(pairs);
    other.drop(pairs);
  }

  std::size_t count() const { return this->Count - this->Next; }
  TSample& operator[](std::size_t i) { return this->Block[this->Offsets[this->Next + i]]; }
  void drop(std::size_t count) { this->Next += count; }

private:
  static constexpr std::ptrdiff_t blockSize = 128;

  /// Scans blocks until samples are listed. @returns whether any are
  template <class Scan>
  bool listBlocks(const Scan& scanBlock)
  {
    while (this->Next == this->Count && this->Unscanned != this->End)
    {
      this->Block = this->Unscanned;
      this->Next = this->Count = 0;
      const std::ptrdiff_t length = std::min(blockSize, this->End - this->Block);
      this->Unscanned += length;
      scanBlock(length);
    }
    return this->Next != this->Count;
  }

  template <class Here, class There>
  void scan(
    std::ptrdiff_t length, const Here& isHere, const There& isThere, SampleList<TSample>& open)
  {
    std::uint8_t others[blockSize];
    std::size_t otherCount = 0;
    for (std::ptrdiff_t i = 0; i < length; ++i)
    {
      others[otherCount] = static_cast<std::uint8_t>(i);
      otherCount += isHere(this->Block[i]) ? 0 : 1;
    }
    TSample** next = open.makeRoom(blockSize);
    std::size_t count = 0;
    for (std::size_t i = 0; i < otherCount; ++i)
    {
      TSample& sample = this->Block[others[i]];
      const std::size_t there = isThere(sample) ? 1 : 0;
      this->Offsets[count] = others[i];
      count += there;
      *next = &sample;
      next += 1 - there;
    }
    open.resize(static_cast<std::size_t>(next - open.begin()));
    this->Count = count;
  }

  TSample* Block;
  TSample* Unscanned;
  TSample* End;
  std::size_t Next = 0;
  std::size_t Count = 0; // end of the list; its first `Next` samples are done
  std::uint8_t Offsets[blockSize];
};

/// Partitions samples in place by swapping misplaced ones.
/// @param belongsLower(sample) must be true for exactly `lowerCount` samples
template <class TSample, class Predicate>
void exchangeMisplaced(
  TSample* samples, std::size_t count, std::size_t lowerCount, const Predicate& belongsLower)
{
  HalfScan<TSample> low(samples, samples + lowerCount);
  HalfScan<TSample> high(samples + lowerCount, samples + count);
  while (low.list([&](const TSample& sample) { return !belongsLower(sample); }) &&
         high.list(belongsLower))
  {
    low.swapListed(high);
  }
}

/// Separates samples around a bracket of their middle on an axis: those below it belong in the
/// lower half, those above it in the upper half.
template <class TSample>
class Separation
{
public:
  Separation(int axis, const MiddleBracket<TSample>& bracket)
    : Axis(axis)
    , Lower(bracket.lower)
    , Upper(bracket.upper)
  {
  }

  /// Swaps misplaced samples until one half has none left.
  /// @param open receives samples inside the bracket
  void exchange(
    HalfScan<TSample>& low, HalfScan<TSample>& high, AmbiguousSamples<TSample>& open) const
  {
    while (this->listLow(low, open) && this->listHigh(high, open))
    {
      low.swapListed(high);
    }
  }

  /// Scans the rest of both halves.
  /// @param open receives samples inside the bracket and misplaced ones
  void finish(
    HalfScan<TSample>& low, HalfScan<TSample>& high, AmbiguousSamples<TSample>& open) const
  {
    while (this->listLow(low, open))
    {
      addListed(low, open.lower);
    }
    while (this->listHigh(high, open))
    {
      addListed(high, open.upper);
    }
  }

  bool listLow(HalfScan<TSample>& low, AmbiguousSamples<TSample>& open) const
  {
    return low.list([this](const TSample& s) { return s.position[this->Axis] < this->Lower; },
      [this](const TSample& s) { return s.position[this->Axis] > this->Upper; }, open.lower);
  }

  bool listHigh(HalfScan<TSample>& high, AmbiguousSamples<TSample>& open) const
  {
    return high.list([this](const TSample& s) { return s.position[this->Axis] > this->Upper; },
      [this](const TSample& s) { return s.position[this->Axis] < this->Lower; }, open.upper);
  }

private:
  static void addListed(HalfScan<TSample>& scan, SampleList<TSample>& list)
  {
    TSample** next = list.makeRoom(scan.count());
    for (std::size_t i = 0; i < scan.count(); ++i)
    {
      next[i] = &scan[i];
    }
    list.resize(list.size() + scan.count());
    scan.drop(scan.count());
  }

  int Axis;
  typename TSample::Coordinate Lower;
  typename TSample::Coordinate Upper;
};

/// Separates the samples of a node around a bracket of their middle.
/// @param open set to the samples in the bracket and a few others. All other samples of the lower
/// half are below the bracket, those of the upper half above it.
template <class TSample>
void separate(TSample* samples, std::size_t count, int axis, const MiddleBracket<TSample>& bracket,
  AmbiguousSamples<TSample>& open)
{
  TSample* const middle = samples + count / 2;
  HalfScan<TSample> low(samples, middle);
  HalfScan<TSample> high(middle, samples + count);
  const Separation<TSample> separation(axis, bracket);
  open.clear();
  separation.exchange(low, high, open);
  separation.finish(low, high, open);
}

/// Separates the samples of a node on all threads: each one separates a part of both halves. The
/// calling thread then exchanges the imbalance of the parts, which is small unless the cloud has a
/// special order.
template <class TSample>
void separateTogether(const Execution& execution, TSample* samples, std::size_t count, int axis,
  const MiddleBracket<TSample>& bracket, AmbiguousSamples<TSample>& open)
{
  struct Part
  {
    HalfScan<TSample> low;
    HalfScan<TSample> high;
    AmbiguousSamples<TSample> open{};
  };
  const std::size_t lowerCount = count / 2;
  const std::size_t upperCount = count - lowerCount;
  TSample* const middle = samples + lowerCount;
  constexpr std::size_t partSamples = std::size_t{ 1 } << 20;
  const std::size_t partCount = std::max(4 * execution.threads, count / partSamples);
  std::vector<Part> parts;
  for (std::size_t i = 0; i < partCount; ++i)
  {
    parts.push_back(
      { { samples + lowerCount * i / partCount, samples + lowerCount * (i + 1) / partCount },
        { middle + upperCount * i / partCount, middle + upperCount * (i + 1) / partCount } });
  }
  const Separation<TSample> separation(axis, bracket);
  forBatches(execution, partCount, 4, 1,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        separation.exchange(parts[i].low, parts[i].high, parts[i].open);
      }
    });

  open.clear();
  std::size_t low = 0;
  std::size_t high = 0;
  while (low < partCount && high < partCount)
  {
    separation.exchange(parts[low].low, parts[high].high, open);
    separation.listLow(parts[low].low, open) ? ++high : ++low;
  }
  for (Part& part : parts)
  {
    separation.finish(part.low, part.high, open);
    open.add(part.open);
  }
}

} // namespace isopoint
