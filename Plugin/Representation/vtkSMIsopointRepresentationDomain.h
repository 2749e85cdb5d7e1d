// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class   vtkSMIsopointRepresentationDomain
 * @brief   offers "Isopoint Splats" for isopoints, and makes it their default representation
 *
 * A domain for a property of the representation's proxy; it sets the property "Representation" of
 * the proxy around it. For data without splats, it keeps the default and removes the type from the
 * list "RepresentationTypesInfo". Empty data have splats if the input had splats before, or if it
 * is the filter that makes them. For other empty data, the default waits for the first points, and
 * is not set then if the type was changed meanwhile. Traces load the plugin if splats are offered.
 *
 * The required property "Input" provides the data.
 */
#ifndef vtkSMIsopointRepresentationDomain_h
#define vtkSMIsopointRepresentationDomain_h

#include "vtkSMDomain.h"
#include "vtkScatteredIsopointRepresentationsModule.h" // for the export macro
#include "vtkWeakPointer.h"

#include <optional> // for the type that is replaced
#include <string>   // for the same

class vtkPVDataInformation;
class vtkSMProxy;
class vtkSMStringVectorProperty;

class VTKSCATTEREDISOPOINTREPRESENTATIONS_EXPORT vtkSMIsopointRepresentationDomain
  : public vtkSMDomain
{
public:
  static vtkSMIsopointRepresentationDomain* New();
  vtkTypeMacro(vtkSMIsopointRepresentationDomain, vtkSMDomain);

  /// The type of representation.
  static constexpr const char* Splats = "Isopoint Splats";

  /**
   * Whether data are isopoints, possibly filtered: they have the point arrays "Normals" of three
   * components and "Radius" of one, and either no cells or one vertex per point.
   */
  static bool AreIsopoints(vtkPVDataInformation* data);

  /**
   * Offers splats, or not, whenever the input or the list of types changes.
   */
  void Update(vtkSMProperty* requestingProperty) override;

  /**
   * Sets the property if the data are isopoints. @returns whether it did
   */
  int SetDefaultValues(vtkSMProperty* property, bool usesUncheckedValues) override;

protected:
  vtkSMIsopointRepresentationDomain() = default;
  ~vtkSMIsopointRepresentationDomain() override = default;

private:
  void OfferSplats();

  /// Finds out whether the input has splats.
  void NoticeSplats();

  /// Sets the default that waited for the first points.
  void SetLateDefault(vtkSMProxy* representation);

  vtkWeakPointer<vtkSMStringVectorProperty> Types; // offered types, in the order of their names
  vtkWeakPointer<vtkSMProxy> Source;               // the input
  bool HasSplats = false;                          // whether it has splats, as far as known
  std::optional<std::string> EmptyDefault;         // the default type of data that are empty yet

  vtkSMIsopointRepresentationDomain(const vtkSMIsopointRepresentationDomain&) = delete;
  void operator=(const vtkSMIsopointRepresentationDomain&) = delete;
};

#endif
