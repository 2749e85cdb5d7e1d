// SPDX-License-Identifier: GPL-3.0-or-later
// Accuracy of isopoints and of the alternatives, measured against analytic surfaces.
#include "AccuracyContestants.h"
#include "AccuracyMeasure.h"
#include "AccuracySamples.h"

#include "AnalyticFields.h"

#include "vtkNew.h"
#include "vtkSMPTools.h"
#include "vtkXMLPolyDataWriter.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <iostream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{

using namespace accuracy;

constexpr const char* usage =
  "usage: AccuracyBenchmark [OPTIONS]\n"
  "Compares isopoints with other methods on samples of analytic fields in the cube [-1, 1]^3 and\n"
  "writes a Markdown table: distances from the true surface in mean sample spacings, errors of\n"
  "normals in degrees, the share of the surface that no splat covers, and seconds.\n"
  "  --samples N         number of samples of each cloud, at least 1000 (default: 64000)\n"
  "  --surface-points N  number of random points of each true surface on which coverage is measured\n"
  "                      (default: 100000)\n"
  "  --fields A,B,...    sphere, torus, gyroid, Marschner-Lobb, Gaussian mixture, cube,\n"
  "                      two sheets (default: all)\n"
  "  --samplings A,...   uniform, clustered, jittered, lines (default: all)\n"
  "  --noise A,...       standard deviations of the noise, in percent of the standard deviation of\n"
  "                      the field over the cube (default: 0,1,5)\n"
  "  --threads N         number of threads of the methods that use several (default: 2)\n"
  "  --output FILE       the table (default: accuracy.md)\n"
  "  --keep FOLDER       also writes all samples and surfaces to this folder, as .vtp files\n"
  "  --help              prints this text\n";

struct Options
{
  std::size_t samples = 64000;
  std::size_t surfacePoints = 100000;
  std::vector<std::string> fields;
  std::vector<std::string> samplings{ accuracy::samplings.begin(), accuracy::samplings.end() };
  std::vector<std::string> noise{ "0", "1", "5" };
  int threads = 2;
  std::string output = "accuracy.md";
  std::string folder;
};

std::vector<std::string> listOf(const std::string& text)
{
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, ',');)
  {
    parts.push_back(part);
  }
  return parts;
}

bool isAmong(const std::vector<std::string>& names, const std::string& name)
{
  return std::find(names.begin(), names.end(), name) != names.end();
}

double numberOf(const std::string& text, double least)
{
  std::size_t used = 0;
  double number = least - 1.0;
  try
  {
    number = std::stod(text, &used);
  }
  catch (const std::exception&)
  {
    // reported below
  }
  if (used != text.size() || !(number >= least))
  {
    std::ostringstream message;
    message << "\"" << text << "\" is not a number of at least " << least;
    throw std::invalid_argument(message.str());
  }
  return number;
}

void checkNames(const std::vector<std::string>& wanted, const std::vector<std::string>& known)
{
  for (const std::string& name : wanted)
  {
    if (!isAmong(known, name))
    {
      throw std::invalid_argument("there is no field or sampling named \"" + name + "\"");
    }
  }
}

Options parse(int count, char** arguments)
{
  constexpr double fewestSamples = 1000.0;
  Options options;
  for (int i = 1; i < count; i += 2)
  {
    const std::string name = arguments[i];
    if (name == "--help")
    {
      std::cout << usage;
      std::exit(0);
    }
    if (i + 1 == count)
    {
      throw std::invalid_argument(name + " needs a value; see --help");
    }
    const std::string value = arguments[i + 1];
    if (name == "--samples")
    {
      options.samples = static_cast<std::size_t>(numberOf(value, fewestSamples));
    }
    else if (name == "--surface-points")
    {
      options.surfacePoints = static_cast<std::size_t>(numberOf(value, 1.0));
    }
    else if (name == "--fields")
    {
      options.fields = listOf(value);
    }
    else if (name == "--samplings")
    {
      options.samplings = listOf(value);
    }
    else if (name == "--noise")
    {
      options.noise = listOf(value);
    }
    else if (name == "--threads")
    {
      options.threads = static_cast<int>(numberOf(value, 1.0));
    }
    else if (name == "--output")
    {
      options.output = value;
    }
    else if (name == "--keep")
    {
      options.folder = value;
    }
    else
    {
      throw std::invalid_argument("there is no option " + name + "; see --help");
    }
  }
  checkNames(options.samplings, { samplings.begin(), samplings.end() });
  for (const std::string& percent : options.noise)
  {
    numberOf(percent, 0.0);
  }
  return options;
}

/// What the rows of the table that follow each other have in common.
struct Subject
{
  const analytic::Surface& surface;
  std::string sampling;
  std::string noise;
  vtkSmartPointer<vtkPolyData> samples;
};

/// Half the side of the cube in which errors are measured: its sides are two mean spacings within
/// those of the samples' cube. Closed surfaces lie entirely within it.
double innerHalfSide(const Options& options)
{
  return 1.0 - 2.0 * meanSpacing(options.samples);
}

/// @returns the formatted value, or a dash for one below 0: not measured
std::string cell(double value, const char* format)
{
  char text[64];
  std::snprintf(text, sizeof(text), format, value);
  return value < 0.0 ? std::string("-") : std::string(text);
}

class Table
{
public:
  explicit Table(const Options& options)
    : Chosen(options)
    , Out(options.output)
  {
    if (!this->Out)
    {
      throw std::runtime_error("cannot write " + options.output);
    }
    this->Out << "| field | sampling | noise % | method | points | largest | 99.9 % | mean |"
                 " normals: largest | mean | uncovered % | rim 99.9 % | seconds |\n"
                 "|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";
  }

  void add(const Subject& subject, const Contestant& contestant,
    const std::vector<analytic::Vector>& truePoints)
  {
    const analytic::Surface& surface = subject.surface;
    std::cerr << surface.name << ", " << subject.sampling << ", noise " << subject.noise
              << " %: " << contestant.name << std::endl;
    const auto start = std::chrono::steady_clock::now();
    const vtkSmartPointer<vtkPolyData> points =
      contestant.extract(subject.samples, surface.isovalue);
    const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    this->keep(subject, contestant.name, points);
    const auto count = static_cast<std::size_t>(subject.samples->GetNumberOfPoints());
    const Measurement found =
      measureAccuracy(points, surface, truePoints, innerHalfSide(this->Chosen), meanSpacing(count));
    this->Out << "| " << surface.name << " | " << subject.sampling << " | " << subject.noise
              << " | " << contestant.name << " | " << found.points << " | "
              << cell(found.largestDistance, "%.4f") << " | "
              << cell(found.quantileDistance, "%.4f") << " | " << cell(found.meanDistance, "%.5f")
              << " | " << cell(found.largestAngle, "%.1f") << " | " << cell(found.meanAngle, "%.2f")
              << " | " << cell(100.0 * found.uncovered, "%.3f") << " | "
              << cell(found.rimDistance, "%.3f") << " | " << cell(seconds, "%.3f") << " |"
              << std::endl;
  }

  void keep(const Subject& subject, const std::string& what, vtkPolyData* points) const
  {
    if (this->Chosen.folder.empty())
    {
      return;
    }
    vtkNew<vtkXMLPolyDataWriter> writer;
    writer->SetFileName((this->Chosen.folder + "/" + subject.surface.name + ", " +
                         subject.sampling + ", " + subject.noise + ", " + what + ".vtp")
                          .c_str());
    writer->SetDataModeToBinary();
    writer->SetInputData(points);
    if (!writer->Write())
    {
      throw std::runtime_error("cannot write to the folder " + this->Chosen.folder);
    }
  }

private:
  const Options& Chosen;
  std::ofstream Out;
};

void compareOn(const analytic::Surface& surface, const Options& options, Table& table)
{
  const std::vector<analytic::Vector> truePoints =
    randomSurfacePoints(surface, options.surfacePoints, innerHalfSide(options), 17);
  const double deviation = deviationOf(surface);
  for (const std::string& noise : options.noise)
  {
    const double noiseDeviation = 0.01 * std::stod(noise) * deviation;
    for (const std::string& sampling : options.samplings)
    {
      const Subject subject{ surface, sampling, noise,
        sampled(surface, positionsOf(sampling, options.samples), noiseDeviation) };
      table.keep(subject, "samples", subject.samples);
      for (const Contestant& contestant : scatteredContestants())
      {
        table.add(subject, contestant, truePoints);
      }
    }
    const Subject grid{ surface, "grid", noise,
      sampled(surface, gridPositions(options.samples), noiseDeviation) };
    table.add(grid, gridContestant(), truePoints);
  }
}

void compare(Options options)
{
  vtkSMPTools::SetBackend("STDThread");
  vtkSMPTools::Initialize(options.threads);
  const std::vector<analytic::Surface> surfaces =
    analytic::allSurfaces(meanSpacing(options.samples));
  std::vector<std::string> known;
  for (const analytic::Surface& surface : surfaces)
  {
    known.push_back(surface.name);
  }
  checkNames(options.fields, known);
  if (options.fields.empty())
  {
    options.fields = known;
  }
  Table table(options);
  for (const analytic::Surface& surface : surfaces)
  {
    if (isAmong(options.fields, surface.name))
    {
      compareOn(surface, options, table);
    }
  }
}

} // namespace

int main(int count, char** arguments)
{
  try
  {
    compare(parse(count, arguments));
  }
  catch (const std::exception& error)
  {
    std::cerr << "AccuracyBenchmark: " << error.what() << "\n";
    return 1;
  }
  return 0;
}
