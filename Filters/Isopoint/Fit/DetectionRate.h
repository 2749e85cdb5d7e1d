// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_DetectionRate_h
#define isopoint_DetectionRate_h

namespace isopoint
{

/// The running rate at which a feature, under-resolved detail or creases, is detected among
/// isopoints close together. In noise it is detected at next to none, and there by chance: the test
/// is then not worth its time. Where it is detected at many, weaker evidence suffices at the
/// others.
class DetectionRate
{
public:
  /// Whether to test the next isopoint: if enough were tested and the feature was detected at next
  /// to none of them, only one in eight is.
  bool isWorthTesting()
  {
    const bool isRare = this->Tested >= fewestTested && this->Detected < rareShare * this->Tested;
    this->Skipped = isRare ? (this->Skipped + 1) % rareStride : 0;
    return this->Skipped == 0;
  }

  /// Whether enough isopoints were tested and the feature was detected at many of them.
  bool isCommon() const
  {
    return this->Tested >= fewestTested && this->Detected >= commonShare * this->Tested;
  }

  void add(bool isDetected)
  {
    this->Tested += 1.0;
    this->Detected += isDetected ? 1.0 : 0.0;
  }

private:
  /// On noise the test errs at one place in thirty or less.
  static constexpr double fewestTested = 16.0;
  static constexpr double rareShare = 0.1;
  static constexpr double commonShare = 0.3;
  static constexpr int rareStride = 8;

  double Tested = 0.0;
  double Detected = 0.0;
  int Skipped = 0; // since the last one that was tested
};

/// The rates of the features that are tested for where residuals are large.
struct DetectionRates
{
  DetectionRate detail;
  DetectionRate creases;
};

} // namespace isopoint

#endif
