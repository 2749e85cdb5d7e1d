// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class   vtkSMIsopointSourceProxy
 * @brief   proxy of a filter of this plugin
 *
 * Updates information properties after each update, so that counters are always current. ParaView
 * does so only when a panel or a script asks for them. Warns if points are saved as STL, because
 * the file would be empty. Traces load the plugin, if necessary, before they create the filter.
 */
#ifndef vtkSMIsopointSourceProxy_h
#define vtkSMIsopointSourceProxy_h

#include "vtkSMSourceProxy.h"
#include "vtkScatteredIsopointRepresentationsModule.h" // for the export macro

class VTKSCATTEREDISOPOINTREPRESENTATIONS_EXPORT vtkSMIsopointSourceProxy : public vtkSMSourceProxy
{
public:
  static vtkSMIsopointSourceProxy* New();
  vtkTypeMacro(vtkSMIsopointSourceProxy, vtkSMSourceProxy);

  /**
   * Makes the active trace, if any, load the plugin at its beginning: classes that Python makes of
   * representations before lack the properties of splats.
   */
  static void LoadInTrace();

protected:
  vtkSMIsopointSourceProxy() = default;
  ~vtkSMIsopointSourceProxy() override = default;

  void AddConsumer(vtkSMProperty* property, vtkSMProxy* consumer) override;
  void CreateVTKObjects() override;
  void PostUpdateData(bool usesCache) override;

private:
  vtkSMIsopointSourceProxy(const vtkSMIsopointSourceProxy&) = delete;
  void operator=(const vtkSMIsopointSourceProxy&) = delete;
};

#endif
