// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What IsosurfaceExtractor::probe() needs.
#include "Core/Places/Neighborhoods.h"
#include "Core/Places/ProbeRequest.h"
