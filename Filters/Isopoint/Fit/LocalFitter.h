// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_LocalFitter_h
#define isopoint_LocalFitter_h

#include "Isopoint/Fit/FrameSamples.h"
#include "Isopoint/Fit/LocalFit.h"
#include "Isopoint/Fit/PolynomialFit.h"

#include <vector>

namespace isopoint
{

class LocalFitter
{
public:
  LocalFitter(double isovalue, FitRequest request)
    : Isovalue(isovalue)
    , Request(request)
  {
  }

  bool fitSmooth(const FitEdge& edge, const std::vector<FitSample>& samples, LocalFit& fit);
  LocalFit fit(const FitEdge& edge, const std::vector<FitSample>& samples);

private:
  bool enterFrame(const FitEdge& edge, const std::vector<FitSample>& samples);
  void apply(const FitEdge& edge, const PolynomialFit& found, double share, LocalFit& fit) const;
  FrameWeights robustWeights(const FrameWeights& steep) const;

  const double Isovalue;
  const FitRequest Request;
  double LengthUnit = 0.0;
  double ValueUnit = 0.0;
  Vector Increasing{};
  FrameSamples Samples;
  std::vector<double> Distances;
};

} // namespace isopoint

#endif
