#pragma once

// Requirements on the compiler and its options; every header includes this one.

// Comparisons refuse NaN and infinity; proofs and exponentials depend on the order of sums.
#if defined(__FAST_MATH__) || defined(__ASSOCIATIVE_MATH__) || defined(_M_FP_FAST) || \
    (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error \
    "holdfast does not compile under -ffast-math, -Ofast or /fp:fast, which remove its checks \
of NaN and reorder its sums: add -fno-fast-math (/fp:precise) for the files that include it"
#endif

// A value that is not admissible is refused by throwing InvalidParameter.
#if !defined(__cpp_exceptions) && !defined(__EXCEPTIONS) && !defined(_CPPUNWIND)
#error \
    "holdfast reports inadmissible values by exceptions: compile the files that include it \
without -fno-exceptions (MSVC: with /EHsc)"
#endif
