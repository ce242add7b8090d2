// Variables that the compiler needs for exceptions. The library for programs without threads defines them once, but
// code that may have threads looks for thread-local ones.

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
