// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class   vtkIsopointSplatRepresentation
 * @brief   renders the points of any data set as one lit surface
 *
 * ParaView's representation "Isopoint Splats": a vtkIsopointSplatMapper on the input's points. Of
 * data sets other than vtkPolyData the points and point arrays are used, of composite data sets
 * those of each block. While the user interacts with a large data set, one splat in LODStride is
 * rendered. Several ranks request a level of ghosts of the input, with which each of them blends
 * its splats. Points that a data set computes, as images do, take 24 bytes each; where there is no
 * memory for them, one error is reported and nothing is rendered.
 *
 * @sa vtkIsopointSplatMapper
 */
#ifndef vtkIsopointSplatRepresentation_h
#define vtkIsopointSplatRepresentation_h

#include "vtkNew.h"
#include "vtkPVDataRepresentation.h"
#include "vtkScatteredIsopointRepresentationsModule.h" // for the export macro
#include "vtkSmartPointer.h"

#include <array>
#include <string>
#include <utility>
#include <vector>

class vtkActor;
class vtkCompositeDataDisplayAttributes;
class vtkDataObject;
class vtkIsopointSplatMapper;
class vtkProperty;
class vtkScalarsToColors;

class VTKSCATTEREDISOPOINTREPRESENTATIONS_EXPORT vtkIsopointSplatRepresentation
  : public vtkPVDataRepresentation
{
public:
  static vtkIsopointSplatRepresentation* New();
  vtkTypeMacro(vtkIsopointSplatRepresentation, vtkPVDataRepresentation);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  int ProcessViewRequest(vtkInformationRequestKey* requestType, vtkInformation* inInfo,
    vtkInformation* outInfo) override;
  void SetVisibility(bool visible) override;

  ///@{
  /**
   * Properties of the mapper, with its ranges, units and defaults; see vtkIsopointSplatMapper.
   */
  void SetRadiusArrayName(const char* name);
  void SetRadius(double radius);
  void SetRadiusScale(double scale);
  void SetBlendDepth(double depth);
  void SetShape(int shape);
  void SetMaximumNumberOfLayers(int count);
  void SetLookupTable(vtkScalarsToColors* table);
  void SetInterpolateScalarsBeforeMapping(int interpolates);
  ///@}

  /**
   * Whether arrays are mapped to colors through the lookup table (1) or contain colors (0).
   * Default: 1.
   */
  void SetMapScalars(int mapsScalars);

  ///@{
  /**
   * Stride of the splats that are rendered where the view requests a lower level of detail; see
   * vtkIsopointSplatMapper::SetStride. Range: 1 or more. Default: 8.
   */
  vtkSetClampMacro(LODStride, int, 1, VTK_INT_MAX);
  vtkGetMacro(LODStride, int);
  ///@}

  ///@{
  /**
   * Selectors of the visible blocks, paths as in vtkDataAssembly, in the hierarchy of the input.
   * Default: "/", all blocks.
   */
  void AddBlockSelector(const char* selector);
  void RemoveAllBlockSelectors();
  ///@}

  ///@{
  /**
   * Color of the blocks of a selector, instead of colors by an array. Range of each component: 0 to
   * 1. Of several colors of a block the last one is used. Default: none.
   */
  void SetBlockColor(const char* selector, double red, double green, double blue);
  void RemoveAllBlockColors();
  ///@}

  ///@{
  /**
   * Properties of the actor; see vtkActor.
   */
  void SetOrientation(double x, double y, double z);
  void SetOrigin(double x, double y, double z);
  void SetPosition(double x, double y, double z);
  void SetScale(double x, double y, double z);
  void SetPickable(int pickable);
  ///@}

  ///@{
  /**
   * Properties of the actor's material; see vtkProperty.
   */
  void SetAmbientColor(double red, double green, double blue);
  void SetDiffuseColor(double red, double green, double blue);
  void SetSpecularColor(double red, double green, double blue);
  void SetEdgeTint(double red, double green, double blue);
  void SetCoatColor(double red, double green, double blue);
  void SetAmbient(double value);
  void SetDiffuse(double value);
  void SetSpecular(double value);
  void SetSpecularPower(double value);
  void SetOpacity(double value);
  void SetInterpolation(int value);
  void SetMetallic(double value);
  void SetRoughness(double value);
  void SetBaseIOR(double value);
  void SetCoatIOR(double value);
  void SetCoatRoughness(double value);
  void SetCoatStrength(double value);
  ///@}

  /**
   * Face culling, by ParaView's constants: 401 culls back faces, 402 culls front faces, any other
   * value culls none. Default: none.
   */
  void SetBackfaceRepresentation(int representation);

protected:
  vtkIsopointSplatRepresentation();
  ~vtkIsopointSplatRepresentation() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  bool AddToView(vtkView* view) override;
  bool RemoveFromView(vtkView* view) override;

  int LODStride = 8;

private:
  vtkIsopointSplatRepresentation(const vtkIsopointSplatRepresentation&) = delete;
  void operator=(const vtkIsopointSplatRepresentation&) = delete;

  void ProvideData(vtkInformation* inInfo, vtkInformation* outInfo);
  void UpdateColoring();
  void UpdateBlockAttributes(vtkDataObject* splats);
  bool MayBeTranslucent();

  vtkNew<vtkIsopointSplatMapper> Mapper;
  vtkNew<vtkActor> Actor;
  vtkNew<vtkCompositeDataDisplayAttributes> BlockAttributes;
  std::vector<std::string> BlockSelectors = { "/" };
  std::vector<std::pair<std::string, std::array<double, 3>>> BlockColors;
  vtkProperty* const Property;           // the actor's
  vtkSmartPointer<vtkDataObject> Splats; // vtkPolyData, within composite data
};

#endif
