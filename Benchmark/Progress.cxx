// SPDX-License-Identifier: GPL-3.0-or-later
// How evenly the filters report their progress, and how soon they stop when asked to.
#include "vtkScatteredIsopointFilter.h"
#include "vtkScatteredIsosurfaceFilter.h"

#include "vtkAlgorithm.h"
#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkFloatArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSMPTools.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <future>
#include <optional>
#include <random>
#include <string>
#include <vector>

namespace
{

constexpr const char* usage =
  "usage: IsopointProgress [--samples N] [--threads N] [--aborts N]\n"
  "Contours random samples (default: 4000000) in the unit cube, of a sphere's distance and of noisy\n"
  "waves, at one isovalue and then, from the kept tree, at another: points alone, points and\n"
  "triangles with the default options. Prints a Markdown table:\n"
  "  seconds    elapsed time\n"
  "  events     the number of times that progress is reported\n"
  "  silence    the longest time between two of them, in seconds; when, as share of the time\n"
  "  deviation  of the progress reported from the share of the time, in points of 100; when\n"
  "  look       the longest time between two looks at an abort, in ms; when\n"
  "  abort      the longest time that an update takes to return, in ms, after another thread aborts\n"
  "             it; when that was. N times are tried (default: 0), spread evenly.\n"
  "--threads N: of vtkSMPTools (default: 2).\n";

double now()
{
  using Clock = std::chrono::steady_clock;
  return std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
}

/// When filters look whether to stop.
std::vector<double> looks;

/// A filter that notes when it looks.
template <class TFilter>
class Watched : public TFilter
{
public:
  static vtkSmartPointer<TFilter> New()
  {
    const auto filter = vtkSmartPointer<TFilter>::Take(new Watched);
    filter->InitializeObjectBase();
    return filter;
  }

  vtkTypeBool GetAbortExecute() override
  {
    looks.push_back(now());
    return this->TFilter::GetAbortExecute();
  }
};

using FilterPointer = vtkSmartPointer<vtkScatteredContourFilter>;

struct Options
{
  int samples = 4000000;
  int threads = 2;
  int aborts = 0;
};

/// The largest of some numbers, and where it was.
struct Largest
{
  double value = 0.0;
  double place = 0.0;

  void add(double other, double otherPlace)
  {
    if (std::abs(other) > std::abs(this->value))
    {
      this->value = other;
      this->place = otherPlace;
    }
  }
};

using Field = std::function<double(const double* position, double noise)>;

double sphere(const double* position, double /*noise*/)
{
  return std::hypot(position[0] - 0.5, position[1] - 0.5, position[2] - 0.5);
}

double noisyWaves(const double* position, double noise)
{
  return std::sin(20.0 * position[0]) + std::sin(20.0 * position[1]) +
         std::sin(20.0 * position[2]) + noise;
}

vtkSmartPointer<vtkPolyData> newSamples(int count, const Field& field)
{
  std::mt19937 random;
  std::uniform_real_distribution<double> uniform;
  std::normal_distribution<double> normal(0.0, 0.1);
  vtkNew<vtkPoints> points;
  points->SetNumberOfPoints(count);
  vtkNew<vtkFloatArray> values;
  values->SetName("field");
  values->SetNumberOfValues(count);
  for (int i = 0; i < count; ++i)
  {
    const double position[3] = { uniform(random), uniform(random), uniform(random) };
    points->SetPoint(i, position);
    values->SetValue(i, static_cast<float>(field(position, normal(random))));
  }
  auto samples = vtkSmartPointer<vtkPolyData>::New();
  samples->SetPoints(points);
  samples->GetPointData()->SetScalars(values);
  return samples;
}

FilterPointer newPointsAlone()
{
  const auto filter = Watched<vtkScatteredIsopointFilter>::New();
  filter->SetProjection(vtkScatteredIsopointFilter::NO_PROJECTION);
  filter->ComputeNormalsOff();
  filter->ComputeSplatsOff();
  return filter;
}

struct Timing
{
  double seconds;
  std::size_t events;
  Largest silence;   // in seconds
  Largest deviation; // in points of 100
  Largest look;      // in seconds
};

/// Updates a filter and watches its progress and looks.
Timing watch(vtkScatteredContourFilter* filter)
{
  struct Report
  {
    double time;
    double progress;
  };
  std::vector<Report> reports;
  vtkNew<vtkCallbackCommand> observer;
  observer->SetClientData(&reports);
  observer->SetCallback(
    [](vtkObject* caller, unsigned long, void* list, void*)
    {
      static_cast<std::vector<Report>*>(list)->push_back(
        { now(), vtkAlgorithm::SafeDownCast(caller)->GetProgress() });
    });
  const unsigned long tag = filter->AddObserver(vtkCommand::ProgressEvent, observer);
  looks.clear();
  const double begin = now();
  filter->Update();
  const double end = now();
  filter->RemoveObserver(tag);

  Timing timing{ end - begin, reports.size(), {}, {}, {} };
  const auto shareAt = [&](double time) { return (time - begin) / timing.seconds; };
  reports.push_back({ end, 1.0 });
  Report last{ begin, 0.0 };
  for (const Report& report : reports)
  {
    // Until a report, the one before it holds.
    timing.deviation.add(100.0 * (last.progress - shareAt(report.time)), shareAt(report.time));
    timing.deviation.add(100.0 * (report.progress - shareAt(report.time)), shareAt(report.time));
    timing.silence.add(report.time - last.time, shareAt(last.time));
    last = report;
  }
  looks.push_back(end);
  double before = begin;
  for (const double look : looks)
  {
    timing.look.add(look - before, shareAt(before));
    before = look;
  }
  return timing;
}

/// How long an update takes to return after an abort at some time.
/// @param prepare() a filter that is ready for the update
Largest measureAborts(const std::function<FilterPointer()>& prepare, double seconds, int count)
{
  Largest latency;
  for (int i = 0; i < count; ++i)
  {
    const FilterPointer filter = prepare();
    const double share = (i + 0.5) / count;
    std::promise<void> ended;
    // When the abort is set, or nothing if the update ends before.
    auto aborted = std::async(std::launch::async,
      [&filter, wait = std::chrono::duration<double>(share * seconds),
        end = ended.get_future()]() -> std::optional<double>
      {
        if (end.wait_for(wait) == std::future_status::ready)
        {
          return std::nullopt;
        }
        const double time = now();
        filter->SetAbortExecute(true);
        return time;
      });
    filter->Update();
    const double end = now();
    ended.set_value();
    latency.add(end - aborted.get().value_or(end), share);
  }
  return latency;
}

void measure(const Options& options, vtkPolyData* samples, const char* name,
  const std::function<FilterPointer()>& makeFilter, const double (&isovalues)[2])
{
  const auto prepareFirst = [&]()
  {
    FilterPointer filter = makeFilter();
    filter->SetInputData(samples);
    filter->SetValue(0, isovalues[0]);
    return filter;
  };
  const auto prepareOther = [&]()
  {
    FilterPointer filter = prepareFirst();
    filter->Update();
    filter->SetValue(0, isovalues[1]);
    return filter;
  };
  const std::function<FilterPointer()> preparations[2] = { prepareFirst, prepareOther };
  for (int i = 0; i < 2; ++i)
  {
    const Timing timing = watch(preparations[i]());
    const Largest abort = measureAborts(preparations[i], timing.seconds, options.aborts);
    std::printf("| %s | %g | %.2f | %zu | %.2f at %.2f | %+.0f at %.2f | %.0f at %.2f | %.0f at "
                "%.2f |\n",
      name, isovalues[i], timing.seconds, timing.events, timing.silence.value, timing.silence.place,
      timing.deviation.value, timing.deviation.place, 1e3 * timing.look.value, timing.look.place,
      1e3 * abort.value, abort.place);
    std::fflush(stdout);
  }
}

void measureField(
  const Options& options, const char* name, const Field& field, const double (&isovalues)[2])
{
  const vtkSmartPointer<vtkPolyData> samples = newSamples(options.samples, field);
  std::printf("\n%s, %d samples, %d threads\n\n", name, options.samples, options.threads);
  std::puts("| output | isovalue | seconds | events | silence | deviation | look | abort |\n"
            "|---|---|---|---|---|---|---|---|");
  measure(options, samples, "points alone", newPointsAlone, isovalues);
  measure(options, samples, "points", Watched<vtkScatteredIsopointFilter>::New, isovalues);
  measure(options, samples, "triangles", Watched<vtkScatteredIsosurfaceFilter>::New, isovalues);
}

bool parse(int argc, char** argv, Options& options)
{
  for (int i = 1; i < argc; i += 2)
  {
    const std::string name = argv[i];
    int* const option = name == "--samples"   ? &options.samples
                        : name == "--threads" ? &options.threads
                        : name == "--aborts"  ? &options.aborts
                                              : nullptr;
    if (!option || i + 1 == argc)
    {
      return false;
    }
    *option = std::max(0, std::atoi(argv[i + 1]));
  }
  return options.threads > 0;
}

} // namespace

int main(int argc, char** argv)
{
  Options options;
  if (!parse(argc, argv, options))
  {
    std::fputs(usage, stderr);
    return 2;
  }
  vtkSMPTools::Initialize(options.threads);
  measureField(options, "Sphere", sphere, { 0.3, 0.4 });
  measureField(options, "Noisy waves", noisyWaves, { 0.5, 0.7 });
  return 0;
}
