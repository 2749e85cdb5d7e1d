// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// Forces inlining where it matters: compilers give up on it in large functions. Each compiler
/// spells the attribute differently and warns about other spellings.
#if defined(__GNUC__)
#define ISOPOINT_ALWAYS_INLINE [[gnu::always_inline]]
#elif defined(_MSC_VER)
#define ISOPOINT_ALWAYS_INLINE __forceinline
#else
#define ISOPOINT_ALWAYS_INLINE
#endif
