// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Library/isopoint.h"

#include "Core/Options.h"

#include <string>

namespace isopoint
{

/// Converts the name of an option, such as DropGaps, to that of its member, drop_gaps.
std::string memberName(const char* name);

/// @param given null for the defaults, or options of any version 1.x
/// @throws UsageError if one is unknown or out of range
Options optionsFrom(const isopoint_options* given);

} // namespace isopoint
