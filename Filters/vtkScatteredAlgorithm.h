// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class   vtkScatteredAlgorithm
 * @brief   base class of the filters on scattered samples
 *
 * Samples are the points of a vtkDataSet, the centers of its cells, or the leaves of a
 * vtkHyperTreeGrid; vtkScatteredIsopointFilter describes them, and which are skipped. All data sets
 * of a composite form one cloud. This class has the properties that all filters on samples share.
 *
 * A failed update reports one error and leaves the output empty, but Update() returns 1.
 * GetErrorCode() returns the cause on all ranks: EINVAL for invalid input or options, ENOMEM for a
 * lack of memory, vtkErrorCode::UnknownError for a bug. It is 0 after a successful update, and
 * after an abort, which also leaves the output empty. It does not change if the filter does not
 * run, for example without an input. The pipeline considers the empty output up to date: call
 * Modified() to try again.
 *
 * @sa
 * vtkScatteredIsopointFilter vtkScatteredIsosurfaceFilter
 */

#ifndef vtkScatteredAlgorithm_h
#define vtkScatteredAlgorithm_h

#include "vtkAlgorithm.h"
#include "vtkScatteredIsopointFiltersModule.h" // for the export macro
#include "vtkSmartPointer.h"                   // for NewOutput()

#include <memory> // for std::unique_ptr

namespace isopoint
{
struct SampleCounts;
}
class vtkDataObject;
class vtkIsopointUpdate;
class vtkMultiProcessController;

class VTKSCATTEREDISOPOINTFILTERS_EXPORT vtkScatteredAlgorithm : public vtkAlgorithm
{
public:
  vtkTypeMacro(vtkScatteredAlgorithm, vtkAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Data objects as inputs, without a pipeline.
   */
  void SetInputData(vtkDataObject* data) { this->SetInputData(0, data); }
  void SetInputData(int port, vtkDataObject* data) { this->SetInputDataInternal(port, data); }
  void AddInputData(vtkDataObject* data) { this->AddInputData(0, data); }
  void AddInputData(int port, vtkDataObject* data) { this->AddInputDataInternal(port, data); }
  vtkDataObject* GetInput() { return this->GetInput(0); }
  vtkDataObject* GetInput(int port);
  ///@}

  /**
   * The output.
   */
  vtkDataObject* GetOutput() { return this->GetOutputDataObject(0); }

  ///@{
  /**
   * Whether to keep the tree between updates, which makes further updates much faster, or to free
   * it at the end of each update. The output is the same. Default: on.
   */
  virtual void SetKeepTree(vtkTypeBool keep);
  virtual vtkTypeBool GetKeepTree();
  vtkBooleanMacro(KeepTree, vtkTypeBool);
  ///@}

  ///@{
  /**
   * The process group (ranks) whose samples form one cloud, in the order of the ranks. All ranks
   * must update the filter, with the same options. A rank may have no samples. The result is that
   * of one process with the samples of all, bit for bit. With null, or a controller of one process,
   * the filter runs on its own. Default: null; in ParaView the global controller.
   */
  virtual void SetController(vtkMultiProcessController* controller);
  vtkMultiProcessController* GetController() const;
  ///@}

  /**
   * SetController() with the global controller, or with null, for callers such as ParaView's
   * proxies.
   */
  void SetUseGlobalController(bool use);

  ///@{
  /**
   * Whether to use all cores if "Sequential" is merely the default backend of vtkSMPTools, as in
   * Debian's ParaView. This is assumed if "Sequential" is active and the environment variable
   * VTK_SMP_BACKEND_IN_USE is not set. The number of threads stays within VTK_SMP_MAX_THREADS and
   * the argument of vtkSMPTools::Initialize(). If off, with any other backend, or if built without
   * oneTBB, vtkSMPTools determines the threads. The output is the same. Default: on.
   */
  virtual void SetUseAllCores(vtkTypeBool use);
  virtual vtkTypeBool GetUseAllCores();
  vtkBooleanMacro(UseAllCores, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Whether messages name properties as ParaView's panel does, "Drop Gaps", rather than as methods,
   * "DropGaps". Default: off; in ParaView on.
   */
  virtual void SetUsePanelNames(vtkTypeBool use);
  virtual vtkTypeBool GetUsePanelNames();
  vtkBooleanMacro(UsePanelNames, vtkTypeBool);
  ///@}

  /**
   * The number of input points (or cells, or leaves) of the last update, including skipped ones.
   */
  vtkIdType GetNumberOfSamples() const;

  /**
   * The number of input points (or cells, or leaves) that the last update skipped. See guarantee 3
   * of vtkScatteredIsopointFilter.
   */
  vtkIdType GetNumberOfSkippedSamples() const;

protected:
  /// @param samplesPort the input port of the samples
  explicit vtkScatteredAlgorithm(int samplesPort = 0);
  ~vtkScatteredAlgorithm() override;

  /**
   * An empty output for the inputs, or null if it is not known yet. By default of the type of input
   * 0.
   */
  virtual vtkSmartPointer<vtkDataObject> NewOutput(vtkInformationVector** inputVector);

  virtual int RequestInformation(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector);
  virtual int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector);
  virtual int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) = 0;

  vtkTypeBool ProcessRequest(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;

  const int SamplesPort;
  const std::unique_ptr<vtkIsopointUpdate> Updater;

private:
  vtkScatteredAlgorithm(const vtkScatteredAlgorithm&) = delete;
  void operator=(const vtkScatteredAlgorithm&) = delete;

  /// Of the last update; all 0 if it failed.
  virtual const isopoint::SampleCounts& GetSampleCounts() const = 0;
};

#endif
