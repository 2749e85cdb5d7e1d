// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class   vtkScatteredGradientFilter
 * @brief   derivatives of an array at scattered samples
 *
 * vtkScatteredGradientFilter adds to its input arrays with the gradient of an array, and of vectors
 * the divergence, the vorticity and the Q-criterion, in the order of components and by the
 * definitions of vtkGradientFilter. Gradients are those of local polynomial fits
 * (docs/algorithm.md, section 13); the connectivity of the input is ignored.
 *
 * Samples are the points, cells or leaves of hyper tree grids that the array belongs to, of all
 * blocks. The array, chosen by SetInputArrayToProcess() (default: the active scalars of the
 * points), may have any number of components. Which samples are skipped, the guarantees on threads
 * and the kept tree are those of vtkScatteredIsopointFilter. An array gets its gradient from the
 * samples where its numbers are finite; skipped samples between these get one, too. It is NaN where
 * the position is not finite and, with a message, outside of the samples in use or where no fit
 * holds.
 *
 * The output is a shallow copy of the input; its new arrays are double, and belong to points or
 * cells as the array does. Blocks without the array get none. In a process group (see
 * SetController()) the inputs of all ranks form one cloud.
 *
 * @sa
 * vtkScatteredProbeFilter vtkGradientFilter
 */

#ifndef vtkScatteredGradientFilter_h
#define vtkScatteredGradientFilter_h

#include "vtkScatteredAlgorithm.h"
#include "vtkScatteredIsopointFiltersModule.h" // for the export macro
#include "vtkSmartPointer.h"                   // for derivatives

#include <memory> // for std::unique_ptr
#include <string> // for the names of arrays
#include <vector> // for a list of these

class vtkDoubleArray;
class vtkIsopointProbing;

class VTKSCATTEREDISOPOINTFILTERS_EXPORT vtkScatteredGradientFilter : public vtkScatteredAlgorithm
{
public:
  static vtkScatteredGradientFilter* New();
  vtkTypeMacro(vtkScatteredGradientFilter, vtkScatteredAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum InterpolationMethods
  {
    BLEND = 0,
    CUBIC = 1,
    QUADRATIC = 2,
    AFFINE = 3
  };

  ///@{
  /**
   * How gradients are computed from the samples around:
   * - BLEND: the gradient of the mean of four fits of degree one to three, weighted by their
   *   estimated errors.
   * - CUBIC, QUADRATIC, AFFINE: that of a fit of this degree, by weighted least squares.
   *
   * Values outside the enumeration are clamped. Default: BLEND.
   */
  vtkSetClampMacro(Interpolation, int, BLEND, AFFINE);
  vtkGetMacro(Interpolation, int);
  ///@}

  ///@{
  /**
   * Whether to compute the gradient: for each component of the array its derivatives by x, y and z,
   * in units of the array per unit of length. Default: on.
   */
  vtkSetMacro(ComputeGradient, vtkTypeBool);
  vtkGetMacro(ComputeGradient, vtkTypeBool);
  vtkBooleanMacro(ComputeGradient, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Whether to compute the divergence, the vorticity (curl; three components) and the Q-criterion
   * of vectors. For an array without three components they are an error. Default: off.
   */
  vtkSetMacro(ComputeDivergence, vtkTypeBool);
  vtkGetMacro(ComputeDivergence, vtkTypeBool);
  vtkBooleanMacro(ComputeDivergence, vtkTypeBool);
  vtkSetMacro(ComputeVorticity, vtkTypeBool);
  vtkGetMacro(ComputeVorticity, vtkTypeBool);
  vtkBooleanMacro(ComputeVorticity, vtkTypeBool);
  vtkSetMacro(ComputeQCriterion, vtkTypeBool);
  vtkGetMacro(ComputeQCriterion, vtkTypeBool);
  vtkBooleanMacro(ComputeQCriterion, vtkTypeBool);
  ///@}

  ///@{
  /**
   * The names of the arrays. Arrays of the input with the same name are replaced. Empty or equal
   * names and "vtkGhostType" are an error in the next update. Default:
   * "Gradients", "Divergence", "Vorticity", "Q-criterion".
   */
  vtkSetStdStringFromCharMacro(ResultArrayName);
  vtkGetCharFromStdStringMacro(ResultArrayName);
  vtkSetStdStringFromCharMacro(DivergenceArrayName);
  vtkGetCharFromStdStringMacro(DivergenceArrayName);
  vtkSetStdStringFromCharMacro(VorticityArrayName);
  vtkGetCharFromStdStringMacro(VorticityArrayName);
  vtkSetStdStringFromCharMacro(QCriterionArrayName);
  vtkGetCharFromStdStringMacro(QCriterionArrayName);
  ///@}

protected:
  vtkScatteredGradientFilter();
  ~vtkScatteredGradientFilter() override;

  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  const std::unique_ptr<vtkIsopointProbing> Probing;

  int Interpolation = BLEND;
  vtkTypeBool ComputeGradient = true;
  vtkTypeBool ComputeDivergence = false;
  vtkTypeBool ComputeVorticity = false;
  vtkTypeBool ComputeQCriterion = false;
  std::string ResultArrayName = "Gradients";
  std::string DivergenceArrayName = "Divergence";
  std::string VorticityArrayName = "Vorticity";
  std::string QCriterionArrayName = "Q-criterion";

private:
  vtkScatteredGradientFilter(const vtkScatteredGradientFilter&) = delete;
  void operator=(const vtkScatteredGradientFilter&) = delete;

  const isopoint::SampleCounts& GetSampleCounts() const override;
  std::vector<std::string> ListNames() const;
  void Compute(vtkInformation* inputInfo, vtkDataObject* output);
  std::vector<vtkSmartPointer<vtkDoubleArray>> Derive(vtkDoubleArray* gradients) const;
};

#endif
