// SPDX-License-Identifier: GPL-3.0-or-later
// The speed of isopoints and of the alternatives, in one run on the same samples.
#include "BenchmarkClouds.h"
#include "Rows.h"

#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkSMPTools.h"
#include "vtkScatteredIsopointFilter.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{

constexpr const char* usage =
  "usage: IsopointBenchmark [--threads N] [--largest MILLIONS] [--file IMAGE.vti ISOVALUE]\n"
  "       IsopointBenchmark [--threads N] --triangles MILLIONS\n"
  "       IsopointBenchmark --paper\n"
  "Times isopoints and other methods on clouds of several kinds and sizes, and writes benchmark.md and\n"
  "benchmark.csv to the current folder.\n"
  "  --threads N             number of threads of the methods that use several (default: 2)\n"
  "  --largest MILLIONS      size of the largest uniform cloud, in millions of samples (default: 64);\n"
  "                          the other methods run on up to 4 million\n"
  "  --file IMAGE ISOVALUE   also contours a volume, interpolated at 16 million random positions\n"
  "  --triangles MILLIONS    compares triangles of a uniform cloud with CGAL's parallel tetrahedrization of\n"
  "                          all samples instead, which takes half a gigabyte for each million\n"
  "  --paper                 repeats Tables 1 and 2 of [RL06] (docs/references.md) instead, and writes\n"
  "                          paper.md\n"
  "  --help                  prints this text\n";

struct Options
{
  int threads = 2;
  double largestMillions = 64.0;
  std::string file;
  double isovalue = 0.0;
  double trianglesMillions = 0.0; // 0: not asked for
  bool paper = false;
};

Options parse(int argumentCount, char** arguments)
{
  Options options;
  const auto fail = []()
  {
    std::cerr << usage;
    std::exit(2);
  };
  const auto number = [&fail](const char* text)
  {
    char* end = nullptr;
    const double value = std::strtod(text, &end);
    if (end == text || *end != '\0')
    {
      fail();
    }
    return value;
  };
  for (int i = 1; i < argumentCount; ++i)
  {
    const std::string argument = arguments[i];
    const int remaining = argumentCount - i - 1;
    if (argument == "--help")
    {
      std::cout << usage;
      std::exit(0);
    }
    if (argument == "--threads" && remaining >= 1)
    {
      options.threads = static_cast<int>(number(arguments[++i]));
    }
    else if (argument == "--largest" && remaining >= 1)
    {
      options.largestMillions = number(arguments[++i]);
    }
    else if (argument == "--file" && remaining >= 2)
    {
      options.file = arguments[++i];
      options.isovalue = number(arguments[++i]);
    }
    else if (argument == "--triangles" && remaining >= 1)
    {
      options.trianglesMillions = number(arguments[++i]);
    }
    else if (argument == "--paper")
    {
      options.paper = true;
    }
    else
    {
      fail();
    }
  }
  if (options.threads < 1)
  {
    fail();
  }
  return options;
}

void append(std::vector<Row>& rows, const std::vector<Row>& more)
{
  rows.insert(rows.end(), more.begin(), more.end());
  writeMarkdown(rows, "benchmark.md");
  writeCsv(rows, "benchmark.csv");
}

constexpr double million = 1e6;

Task uniformTask(const Options& options, double millions)
{
  return { "uniform", clouds::uniform(static_cast<std::size_t>(millions * million)), 70.0,
    options.threads, true };
}

void compareTriangles(const Options& options)
{
  const Task task = uniformTask(options, options.trianglesMillions);
  std::vector<Row> rows;
  append(rows, measureTriangles(task, copySeconds(task.samples)));
}

void compare(const Options& options)
{
  constexpr double largestWithPeers = 4.0;
  std::vector<Row> rows;
  for (const double millions : { 0.05, 0.25, 1.0, 4.0, 8.0, 16.0, 32.0, 64.0, 128.0 })
  {
    if (millions <= options.largestMillions)
    {
      const Task task = uniformTask(options, millions);
      const double copy = copySeconds(task.samples);
      const std::vector<Row> ours = measureOurs(task, copy);
      append(rows, ours);
      if (millions <= largestWithPeers)
      {
        append(rows, measurePeers(task, copy, ours.front()));
      }
    }
  }
  constexpr std::size_t otherCount = 4000000;
  for (const Task& task : { Task{ "clustered", clouds::clustered(otherCount) },
         Task{ "slab", clouds::slab(otherCount) }, Task{ "lattice", clouds::lattice(otherCount) } })
  {
    Task threaded = task;
    threaded.threads = options.threads;
    append(rows, measureOurs(threaded, copySeconds(task.samples)));
  }
  if (!options.file.empty())
  {
    const Task task{ "file", clouds::resampled(options.file, 16000000), options.isovalue,
      options.threads, false };
    append(rows, measureOurs(task, copySeconds(task.samples)));
  }
}

/// Tables 1 and 2 of [RL06], beside the numbers given there: those of a core of 3.06 GHz.
void repeatPaper(const Options& options)
{
  struct PublishedRow
  {
    double millions;
    double angle;
    double points;
    double seconds;   // 0: not given
    double deviation; // 0: not given
  };
  const std::vector<PublishedRow> table{ { 4, 54.7, 45000, 70, 0 }, { 8, 54.7, 71000, 151, 0 },
    { 12, 54.7, 100000, 243, 0 }, { 16, 54.7, 113000, 318, 0 }, { 8, 15, 437473, 0, 0.0425 },
    { 8, 35, 227588, 0, 0.0355 }, { 8, 55, 77512, 0, 0.0320 }, { 8, 80, 64165, 0, 0.0182 } };
  vtkSMPTools::Initialize(options.threads);
  std::FILE* const out = std::fopen("paper.md", "w");
  if (!out)
  {
    throw std::runtime_error("cannot write paper.md");
  }
  std::fprintf(out,
    "Columns marked [RL06] are the numbers given there. The others are those of a single run on %d"
    " threads, with isopoints on their edges (linear) and moved to quadratic fits (quadratic).\n\n",
    options.threads);
  std::fprintf(out, "| samples, million | angle | points [RL06] | points | seconds [RL06] |"
                    " seconds, linear | seconds, quadratic | largest deviation [RL06] |"
                    " largest deviation, linear | largest deviation, quadratic |\n"
                    "|---|---|---|---|---|---|---|---|---|---|\n");
  for (const PublishedRow& published : table)
  {
    const auto samples = clouds::uniform(static_cast<std::size_t>(published.millions * 1e6));
    const auto measured = [&](int projection)
    {
      vtkNew<vtkScatteredIsopointFilter> filter;
      filter->SetInputData(samples);
      filter->SetAngle(published.angle);
      filter->SetValue(0, 70.0);
      filter->SetProjection(projection);
      filter->ComputeNormalsOff();
      filter->ComputeSplatsOff();
      Row row;
      row = measure(row, [&]() { filter->Update(); });
      measureSphere(row, filter->GetOutput(), 70.0);
      return row;
    };
    const Row linear = measured(vtkScatteredIsopointFilter::NO_PROJECTION);
    const Row quadratic = measured(vtkScatteredIsopointFilter::QUADRATIC_FIT);
    std::fprintf(out, "| %g | %g | %.0f | %zu | %g | %.2f | %.2f | %g | %.4f | %.5f |\n",
      published.millions, published.angle, published.points, linear.surfacePoints,
      published.seconds, linear.seconds, quadratic.seconds, published.deviation,
      linear.largestDeviation, quadratic.largestDeviation);
  }
  std::fclose(out);
}

} // namespace

int main(int argumentCount, char** arguments)
{
  try
  {
    const Options options = parse(argumentCount, arguments);
    vtkSMPTools::SetBackend("STDThread");
    if (options.paper)
    {
      repeatPaper(options);
    }
    else if (options.trianglesMillions > 0.0)
    {
      compareTriangles(options);
    }
    else
    {
      compare(options);
    }
  }
  catch (const std::exception& error)
  {
    std::cerr << "IsopointBenchmark: " << error.what() << "\n";
    return 1;
  }
  return 0;
}
