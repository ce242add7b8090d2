/* Preloaded into the program: lets one call fail, as a machine without memory or a full disk would.
   FAULT=KIND:N fails the N-th call, from 0, of its kind after main() begins: allocation, open, write, sync or rename.
   FAULT_COUNTS=FILE gets a line "KIND NUMBER" for each kind when the program ends. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { allocation, opening, writing, syncing, renaming, kinds };
static const char* const names[kinds] = {"allocation", "open", "write", "sync", "rename"};
static const int numbers[kinds] = {ENOMEM, ENOSPC, ENOSPC, EIO, EACCES};
static atomic_long counts[kinds];
static long failing[kinds] = {-1, -1, -1, -1, -1};
static int counts_file = -1;
static atomic_int is_running;

extern void* __libc_malloc(size_t);

static void begin(void) {
  const char* fault = getenv("FAULT");
  for (int kind = 0; fault && kind < kinds; ++kind) {
    const size_t length = strlen(names[kind]);
    if (strncmp(fault, names[kind], length) == 0 && fault[length] == ':') failing[kind] = atol(fault + length + 1);
  }
  const char* path = getenv("FAULT_COUNTS");
  if (path) counts_file = open(path, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  is_running = 1;
}

static int (*program)(int, char**, char**);

static int run(int count, char** words, char** environment) {
  begin();
  return program(count, words, environment);
}

int __libc_start_main(int (*main)(int, char**, char**), int count, char** words, void (*init)(void), void (*fini)(void),
                      void (*rtld_fini)(void), void* stack_end) {
  int (*next)(int (*)(int, char**, char**), int, char**, void (*)(void), void (*)(void), void (*)(void), void*);
  *(void**)&next = dlsym(RTLD_NEXT, "__libc_start_main");
  program = main;
  return next(run, count, words, init, fini, rtld_fini, stack_end);
}

__attribute__((destructor)) static void end(void) {
  if (counts_file < 0) return;
  long found[kinds];
  for (int kind = 0; kind < kinds; ++kind) found[kind] = counts[kind];
  for (int kind = 0; kind < kinds; ++kind) dprintf(counts_file, "%s %ld\n", names[kind], found[kind]);
}

static int fails(int kind) {
  if (!is_running || atomic_fetch_add(&counts[kind], 1) != failing[kind]) return 0;
  errno = numbers[kind];
  return 1;
}

void* malloc(size_t size) { return fails(allocation) ? NULL : __libc_malloc(size); }

int open(const char* path, int flags, ...) {
  static int (*next)(const char*, int, ...);
  if (!next) next = (int (*)(const char*, int, ...))dlsym(RTLD_NEXT, "open");
  mode_t mode = 0;
  if (flags & O_CREAT) {
    va_list rest;
    va_start(rest, flags);
    mode = va_arg(rest, mode_t);
    va_end(rest);
    if (fails(opening)) return -1;
  }
  return next(path, flags, mode);
}

ssize_t write(int file, const void* bytes, size_t size) {
  static ssize_t (*next)(int, const void*, size_t);
  if (!next) next = (ssize_t(*)(int, const void*, size_t))dlsym(RTLD_NEXT, "write");
  if (file > 2 && fails(writing)) return -1;
  return next(file, bytes, size);
}

int fsync(int file) {
  static int (*next)(int);
  if (!next) next = (int (*)(int))dlsym(RTLD_NEXT, "fsync");
  return fails(syncing) ? -1 : next(file);
}

int rename(const char* from, const char* to) {
  static int (*next)(const char*, const char*);
  if (!next) next = (int (*)(const char*, const char*))dlsym(RTLD_NEXT, "rename");
  return fails(renaming) ? -1 : next(from, to);
}
