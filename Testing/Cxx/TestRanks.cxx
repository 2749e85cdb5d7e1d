// SPDX-License-Identifier: GPL-3.0-or-later
// Whatever ranks a cloud is dealt out to, they yield together what one process does.
#include "RankTesting.h"

#include <gtest/gtest.h>

namespace
{

using clouds::Cloud;

std::vector<Cloud> variousClouds()
{
  return { clouds::uniform(3000, 1), clouds::clustered(2000, 2), clouds::lattice(14, 13, 12),
    clouds::coarse(1500, 6, 3), clouds::coincident(clouds::uniform(1200, 4), 0.4),
    clouds::lines(600, 5, 0, 5), clouds::lines(900, 7, 40, 6), clouds::combs(700, 9, 7),
    clouds::curves(900, 8), clouds::flattened(clouds::uniform(900, 9), 2),
    clouds::flattened(clouds::uniform(300, 10), 1), clouds::nestedCoincident(400),
    clouds::layerBeforeOne(900, 11) };
}

} // namespace

TEST(Ranks, YieldThePointsOfOneProcess)
{
  for (const Cloud& cloud : variousClouds())
  {
    for (const int size : { 2, 3, 4, 7 })
    {
      for (const ranks::Deal deal : ranks::allDeals)
      {
        SCOPED_TRACE(
          std::to_string(size) + " ranks, deal " + std::to_string(static_cast<int>(deal)));
        isopoint::ExtractionRequest request;
        request.isosurface.isovalue = 0.3;
        ranks::expectSameAsOneProcess(cloud, size, deal, { request });
      }
    }
  }
}

TEST(Ranks, MoreThanSamples)
{
  for (std::size_t count = 0; count < 6; ++count)
  {
    isopoint::ExtractionRequest request;
    request.isosurface.isovalue = 0.3;
    ranks::expectSameAsOneProcess(
      clouds::uniform(count, 12), 7, ranks::Deal::RoundRobin, { request });
  }
}

TEST(Ranks, GapsAndAnglesAndFurtherIsovalues)
{
  for (const Cloud& cloud : variousClouds())
  {
    std::vector<isopoint::ExtractionRequest> requests(3);
    requests[0].isosurface = { 0.1, 0.0, 0.0, std::nullopt };
    requests[1].isosurface = { 0.9, 54.7, 2.0, std::nullopt };
    requests[2].isosurface = { -0.4, 120.0, 4.0, std::nullopt };
    for (const int size : { 2, 5 })
    {
      ranks::expectSameAsOneProcess(cloud, size, ranks::Deal::Skewed, requests);
    }
  }
}

TEST(Ranks, YieldTheFitsOfOneProcess)
{
  std::vector<isopoint::ExtractionRequest> requests(3);
  requests[0].isosurface = { 0.3, 54.7, 0.0,
    isopoint::FitRequest{ isopoint::FitOrder::Cubic, true } };
  requests[1].isosurface = { -0.2, 54.7, 3.0,
    isopoint::FitRequest{ isopoint::FitOrder::Crease, true } };
  requests[2].isosurface = { 0.5, 54.7, 0.0, isopoint::FitRequest{ std::nullopt, false } };
  for (const Cloud& cloud : variousClouds())
  {
    for (const int size : { 2, 7 })
    {
      ranks::expectSameAsOneProcess(cloud, size, ranks::Deal::RoundRobin, requests);
    }
  }
}

TEST(Ranks, YieldTheSplatsOfOneProcess)
{
  std::vector<isopoint::ExtractionRequest> requests(4);
  requests[0].isosurface = { 0.3, 54.7, 0.0,
    isopoint::FitRequest{ isopoint::FitOrder::Cubic, true } };
  requests[1].isosurface = { -0.2, 54.7, 3.0,
    isopoint::FitRequest{ isopoint::FitOrder::Crease, true } };
  requests[1].minimumSpacing = 0.5;
  requests[2].isosurface = { 0.5, 54.7, 0.0, isopoint::FitRequest{ std::nullopt, false } };
  requests[3].isosurface = { 0.3, 54.7, 0.0, std::nullopt };
  for (isopoint::ExtractionRequest& request : requests)
  {
    request.splats = isopoint::SplatOptions();
  }
  requests[2].splats->fieldNormals = false;
  for (const Cloud& cloud : variousClouds())
  {
    for (const int size : { 2, 7 })
    {
      ranks::expectSameAsOneProcess(cloud, size, ranks::Deal::RoundRobin, requests);
    }
  }
}
