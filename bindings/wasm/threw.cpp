// What the compiler makes exceptions with. The library that is linked where there are no threads defines it once for
// all of them, but code that may have threads looks for one of each thread's own.

#include <cstdint>

extern "C" {

thread_local std::uintptr_t __THREW__ = 0;
thread_local int __threwValue = 0;

void setThrew(std::uintptr_t threw, int value) {
  if (__THREW__ != 0) return;
  __THREW__ = threw;
  __threwValue = value;
}
}
