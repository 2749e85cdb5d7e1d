// SPDX-License-Identifier: GPL-3.0-or-later
// How evenly the filter reports its progress, and how soon it stops when asked to.
#include "vtkScatteredIsopointFilter.h"

#include "vtkAlgorithm.h"
#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkSMPTools.h"
#include "vtkSmartPointer.h"
#include "vtkXMLImageDataReader.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace
{

constexpr const char* usage =
  "usage: IsopointProgress FILE.vti ISOVALUE OTHER [--threads N] [--aborts N]\n"
  "Contours a volume at ISOVALUE and then, from the kept tree, at OTHER; points alone and with the\n"
  "default options. Prints a Markdown table:\n"
  "  seconds    elapsed time\n"
  "  deviation  of the progress reported from the share of the time, in points of 100; where\n"
  "  gap        the longest time between two looks at an abort, in ms; where, as share of the time\n"
  "  abort      the longest time that an update takes to return, in ms, after another thread aborts\n"
  "             it; when that was. N times are tried (default: 20), spread evenly.\n"
  "The second line of each pair is the other isovalue. --threads N: of vtkSMPTools (default: 2).\n";

double now()
{
  using Clock = std::chrono::steady_clock;
  return std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
}

/// The filter, which notes when it looks whether to stop.
class WatchedFilter : public vtkScatteredIsopointFilter
{
public:
  static WatchedFilter* New();
  vtkTypeMacro(WatchedFilter, vtkScatteredIsopointFilter);

  vtkTypeBool GetAbortExecute() override
  {
    this->Looks.push_back(now());
    return this->vtkScatteredIsopointFilter::GetAbortExecute();
  }

  std::vector<double> Looks;

protected:
  WatchedFilter() { this->Looks.reserve(1 << 16); }
};
vtkStandardNewMacro(WatchedFilter);

struct Options
{
  std::string file;
  double isovalues[2];
  int threads = 2;
  int aborts = 20;
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

/// Sets a filter's abort after some seconds, from a thread of its own, unless it is destroyed
/// before.
class DelayedAbort
{
public:
  DelayedAbort(vtkAlgorithm* filter, double seconds)
    : Thread(
        [this, filter, seconds]()
        {
          std::unique_lock<std::mutex> lock(this->Mutex);
          if (!this->Wake.wait_for(
                lock, std::chrono::duration<double>(seconds), [this]() { return this->Canceled; }))
          {
            this->Time = now();
            filter->SetAbortExecute(true);
          }
        })
  {
  }

  /// When the abort was set, or 0 if it was not.
  double stop()
  {
    {
      const std::lock_guard<std::mutex> lock(this->Mutex);
      this->Canceled = true;
    }
    this->Wake.notify_one();
    this->Thread.join();
    return this->Time;
  }

private:
  std::mutex Mutex;
  std::condition_variable Wake;
  bool Canceled = false;
  double Time = 0.0;
  std::thread Thread;
};

vtkSmartPointer<vtkImageData> read(const std::string& file)
{
  vtkNew<vtkXMLImageDataReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  vtkSmartPointer<vtkImageData> volume = reader->GetOutput();
  if (!volume->GetPointData()->GetScalars() && volume->GetPointData()->GetNumberOfArrays() > 0)
  {
    volume->GetPointData()->SetActiveScalars(volume->GetPointData()->GetArrayName(0));
  }
  return volume;
}

vtkSmartPointer<WatchedFilter> makeFilter(vtkImageData* volume, bool pointsAlone)
{
  vtkSmartPointer<WatchedFilter> filter = vtkSmartPointer<WatchedFilter>::New();
  filter->SetInputData(volume);
  if (pointsAlone)
  {
    filter->SetProjection(vtkScatteredIsopointFilter::NO_PROJECTION);
    filter->ComputeNormalsOff();
    filter->ComputeSplatsOff();
  }
  return filter;
}

struct Timing
{
  double seconds;
  Largest deviation; // in points of 100
  Largest gap;       // in seconds
};

/// Updates a filter and watches its progress and looks.
Timing watch(WatchedFilter* filter)
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
  filter->Looks.clear();
  const double begin = now();
  filter->Update();
  const double end = now();
  filter->RemoveObserver(tag);

  Timing timing{ end - begin, {}, {} };
  double before = 0.0;
  for (const Report& report : reports)
  {
    // Until a report, the one before it holds.
    const double share = (report.time - begin) / timing.seconds;
    timing.deviation.add(100.0 * (before - share), share);
    timing.deviation.add(100.0 * (report.progress - share), share);
    before = report.progress;
  }
  double last = begin;
  filter->Looks.push_back(end);
  for (const double look : filter->Looks)
  {
    timing.gap.add(look - last, (last - begin) / timing.seconds);
    last = look;
  }
  return timing;
}

/// How long an update takes to return after an abort at some time.
/// @param prepare() a filter that is ready for the update
Largest measureAborts(
  const std::function<vtkSmartPointer<WatchedFilter>()>& prepare, double seconds, int count)
{
  Largest latency;
  for (int i = 0; i < count; ++i)
  {
    const vtkSmartPointer<WatchedFilter> filter = prepare();
    const double share = (i + 0.5) / count;
    DelayedAbort abort(filter, share * seconds);
    filter->Update();
    const double end = now();
    const double aborted = abort.stop();
    latency.add(aborted > 0.0 ? end - aborted : 0.0, share);
  }
  return latency;
}

void printRow(const Options& options, bool pointsAlone, const char* which, const Timing& timing,
  const Largest& latency)
{
  std::printf("| %s | %s | %d | %.2f | %+.0f at %.2f | %.0f at %.2f | %.0f at %.2f |\n",
    pointsAlone ? "points alone" : "default", which, options.threads, timing.seconds,
    timing.deviation.value, timing.deviation.place, 1e3 * timing.gap.value, timing.gap.place,
    1e3 * latency.value, latency.place);
  std::fflush(stdout);
}

void measure(const Options& options, vtkImageData* volume, bool pointsAlone)
{
  const auto prepareFirst = [&]()
  {
    const auto filter = makeFilter(volume, pointsAlone);
    filter->SetValue(0, options.isovalues[0]);
    return filter;
  };
  const auto prepareOther = [&]()
  {
    const auto filter = prepareFirst();
    filter->Update();
    filter->SetValue(0, options.isovalues[1]);
    return filter;
  };
  const Timing first = watch(prepareFirst());
  printRow(options, pointsAlone, "first", first,
    measureAborts(prepareFirst, first.seconds, options.aborts));
  const Timing other = watch(prepareOther());
  printRow(options, pointsAlone, "other", other,
    measureAborts(prepareOther, other.seconds, options.aborts));
}

bool parse(int argc, char** argv, Options& options)
{
  if (argc < 4)
  {
    return false;
  }
  options.file = argv[1];
  options.isovalues[0] = std::atof(argv[2]);
  options.isovalues[1] = std::atof(argv[3]);
  for (int i = 4; i < argc; i += 2)
  {
    const std::string name = argv[i];
    if (i + 1 == argc || (name != "--threads" && name != "--aborts"))
    {
      return false;
    }
    (name == "--threads" ? options.threads : options.aborts) = std::max(1, std::atoi(argv[i + 1]));
  }
  return true;
}

} // namespace

int main(int argc, char** argv)
try
{
  Options options;
  if (!parse(argc, argv, options))
  {
    std::fputs(usage, stderr);
    return 2;
  }
  const vtkSmartPointer<vtkImageData> volume = read(options.file);
  if (volume->GetNumberOfPoints() == 0)
  {
    std::fprintf(stderr, "%s: no voxels could be read\n", options.file.c_str());
    return 1;
  }
  vtkSMPTools::Initialize(options.threads);
  std::puts("| options | isovalue | threads | seconds | deviation | gap | abort |\n"
            "|---|---|---|---|---|---|---|");
  measure(options, volume, true);
  measure(options, volume, false);
  return 0;
}
catch (const std::exception& error)
{
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
