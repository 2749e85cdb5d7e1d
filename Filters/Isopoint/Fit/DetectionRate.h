// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_DetectionRate_h
#define isopoint_DetectionRate_h

namespace isopoint
{

/// Counts how often samples tell of what is looked for, detail or creases, among isopoints that lie
/// close together. In noise, next to none do, and those by chance: there the question is not worth
/// its time. Where many do, weaker evidence of the others is to be believed.
class DetectionRate
{
public:
  /// Whether to ask the next isopoint: where next to none of those asked told of it, if there were
  /// enough of them, only one in eight is.
  bool isWorthTesting()
  {
    const bool isRare = this->Asked >= fewestAsked && this->Told < rareShare * this->Asked;
    this->Skipped = isRare ? (this->Skipped + 1) % rareStride : 0;
    return this->Skipped == 0;
  }

  /// Whether many of those asked told of it, if there were enough of them.
  bool isCommon() const
  {
    return this->Asked >= fewestAsked && this->Told >= commonShare * this->Asked;
  }

  void add(bool told)
  {
    this->Asked += 1.0;
    this->Told += told ? 1.0 : 0.0;
  }

private:
  /// In noise the criterion errs at one place in thirty or less.
  static constexpr double fewestAsked = 16.0;
  static constexpr double rareShare = 0.1;
  static constexpr double commonShare = 0.3;
  static constexpr int rareStride = 8;

  double Asked = 0.0;
  double Told = 0.0;
  int Skipped = 0; // lately
};

/// What is looked for where residuals are large.
struct DetectionRates
{
  DetectionRate detail;
  DetectionRate creases;
};

} // namespace isopoint

#endif
