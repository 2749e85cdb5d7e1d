// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class   vtkSMIsopointSourceProxy
 * @brief   proxy of a filter of this plugin
 *
 * ParaView asks a filter for its information properties where a panel or a script calls for that.
 * This proxy does so after each update, so that counters are always those of the last one.
 *
 * Where points are saved as STL, it warns that the file will be empty.
 *
 * Traces load the plugin, if it is not loaded when they are run, before they create the filter.
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
