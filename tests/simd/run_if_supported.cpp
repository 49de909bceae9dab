// run_if_supported avx2|avx512 PROGRAM: runs the program where the processor has the instructions
// that it was compiled for, else ends with 77, which the test runner counts as skipped.
#include <unistd.h>

#include <cstdio>
#include <cstring>

int main(int count, char** arguments) {
  if (count != 3) return std::fputs("usage: run_if_supported avx2|avx512 PROGRAM\n", stderr), 2;
#if defined(__x86_64__)
  __builtin_cpu_init();
  const bool wide = std::strcmp(arguments[1], "avx512") == 0;
  const bool supported =
      wide ? __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
                 __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl")
           : __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  if (supported) {
    execv(arguments[2], arguments + 2);
    return std::perror(arguments[2]), 1;
  }
#endif
  std::printf("this processor has no %s\n", arguments[1]);
  return 77;
}
