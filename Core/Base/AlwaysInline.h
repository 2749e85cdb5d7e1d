// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_AlwaysInline_h
#define isopoint_AlwaysInline_h

/// Forces a function to be inlined: compilers give up on that in large functions, where it matters
/// most. Each compiler spells this attribute differently and warns about other spellings.
#if defined(__GNUC__)
#define ISOPOINT_ALWAYS_INLINE [[gnu::always_inline]]
#elif defined(_MSC_VER)
#define ISOPOINT_ALWAYS_INLINE __forceinline
#else
#define ISOPOINT_ALWAYS_INLINE
#endif

#endif
