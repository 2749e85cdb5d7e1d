// SPDX-License-Identifier: GPL-3.0-or-later
#include "Report.h"

#include "vtkPolyData.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <malloc.h>
#include <sstream>

namespace
{

/// An entry of the process's status that is given there in kilobytes, in bytes.
double statusBytes(const std::string& key)
{
  std::ifstream status("/proc/self/status");
  std::string line;
  while (std::getline(status, line))
  {
    if (line.compare(0, key.size(), key) == 0)
    {
      return 1024.0 * std::stod(line.substr(key.size() + 1));
    }
  }
  return 0.0;
}

void resetPeakMemory()
{
  std::ofstream("/proc/self/clear_refs") << "5";
}

std::string number(double value, const char* format)
{
  char text[64];
  std::snprintf(text, sizeof(text), format, value);
  return text;
}

std::string ratio(double numerator, double denominator)
{
  return denominator > 0.0 ? number(numerator / denominator, "%.3g") : std::string();
}

std::string deviation(double value)
{
  return value < 0.0 ? std::string() : number(value, "%.5f");
}

} // namespace

Row measure(const Row& description, const std::function<void()>& work)
{
  Row row = description;
  std::cerr << row.cloud << ", " << row.samples << " samples: " << row.what << " ..." << std::flush;
  malloc_trim(0); // memory that was freed must not hide what is taken now
  resetPeakMemory();
  const double before = statusBytes("VmRSS:");
  const auto start = std::chrono::steady_clock::now();
  work();
  row.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  row.peakBytes = std::max(0.0, statusBytes("VmHWM:") - before);
  std::cerr << " " << number(row.seconds, "%.3f") << " s\n";
  return row;
}

void measureSphere(Row& row, vtkPolyData* points, double radius)
{
  double largest = 0.0;
  double sum = 0.0;
  const vtkIdType count = points->GetNumberOfPoints();
  for (vtkIdType i = 0; i < count; ++i)
  {
    double p[3];
    points->GetPoint(i, p);
    const double distance = std::abs(std::hypot(p[0], p[1], p[2]) - radius);
    largest = std::max(largest, distance);
    sum += distance;
  }
  row.surfacePoints = static_cast<std::size_t>(count);
  row.largestDeviation = largest;
  row.meanDeviation = count > 0 ? sum / static_cast<double>(count) : -1.0;
}

void writeMarkdown(const std::vector<Row>& rows, const std::string& path)
{
  std::ofstream out(path);
  out << "| cloud | samples | threads | method | seconds | relative to isopoints |"
         " relative to a copy | surface points |"
         " largest deviation | mean deviation | peak memory, bytes/sample |\n"
         "|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (const Row& row : rows)
  {
    out << "| " << row.cloud << " | " << row.samples << " | " << row.threads << " | " << row.what
        << " | " << number(row.seconds, "%.4f") << " | " << ratio(row.seconds, row.oursSeconds)
        << " | " << ratio(row.seconds, row.copySeconds) << " | " << row.surfacePoints << " | "
        << deviation(row.largestDeviation) << " | " << deviation(row.meanDeviation) << " | "
        << number(row.peakBytes / static_cast<double>(row.samples), "%.1f") << " |\n";
  }
}

void writeCsv(const std::vector<Row>& rows, const std::string& path)
{
  std::ofstream out(path);
  out << "cloud,what,samples,threads,seconds,times_ours,copies,surface_points,largest_deviation,"
         "mean_deviation,peak_bytes_per_sample\n";
  for (const Row& row : rows)
  {
    out << row.cloud << "," << row.what << "," << row.samples << "," << row.threads << ","
        << number(row.seconds, "%.6f") << "," << ratio(row.seconds, row.oursSeconds) << ","
        << ratio(row.seconds, row.copySeconds) << "," << row.surfacePoints << ","
        << deviation(row.largestDeviation) << "," << deviation(row.meanDeviation) << ","
        << number(row.peakBytes / static_cast<double>(row.samples), "%.2f") << "\n";
  }
}
