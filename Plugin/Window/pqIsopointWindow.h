// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef pqIsopointWindow_h
#define pqIsopointWindow_h

#include <functional>

class QObject;

/// Calls a function when ParaView's window is complete: at once if it is. ParaView loads the
/// plugins that PV_PLUGIN_PATH and configuration files name before it makes its window, its menus,
/// and even its core.
/// @param context the function is not called after this object is deleted
void pqCallWithWindow(QObject* context, const std::function<void()>& function);

#endif
