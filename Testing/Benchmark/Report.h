// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef Report_h
#define Report_h

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

class vtkPolyData;

/// One line of a table.
struct Row
{
  std::string cloud;
  std::string what;
  std::size_t samples = 0;
  int threads = 0;
  double seconds = 0.0;
  std::size_t surfacePoints = 0;
  double largestDeviation = -1.0; // from the sphere; below 0: not known
  double meanDeviation = -1.0;
  double peakBytes = 0.0; // in addition to the memory in use before
  double copySeconds = 0.0;
  double oursSeconds = 0.0; // of isopoints of the same samples, to which others are related
};

/// Runs a piece of work, measures its time and the growth of resident memory, and reports progress
/// to standard error.
Row measure(const Row& description, const std::function<void()>& work);

/// Fills in the points and their distances from the sphere of that radius around the origin.
void measureSphere(Row& row, vtkPolyData* points, double radius);

/// Writes the rows as a Markdown table and as comma-separated values.
void writeMarkdown(const std::vector<Row>& rows, const std::string& path);
void writeCsv(const std::vector<Row>& rows, const std::string& path);

#endif
