/* Preloaded into the program: lets calls fail, as a machine without memory or a full disk would.
   FAULT=KIND:N fails the N-th call, from 0, of its kind after main() begins: allocation, open, write, sync (of a file),
   folder (its sync), rename or thread. FAULT=KIND:N+ fails that one and all after it.
   FAULT_COUNTS=FILE gets a line "KIND NUMBER" for each kind when the program ends.
   AFTER_READ=COMMAND is run by the shell when the program has read from a file for the first time. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <pthread.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { allocation, opening, writing, syncing, syncing_folder, renaming, threading, kinds };
static const char* const names[kinds] = {"allocation", "open", "write", "sync", "folder", "rename", "thread"};
static const int numbers[kinds] = {ENOMEM, ENOSPC, ENOSPC, EIO, EIO, EACCES, EAGAIN};
static atomic_long counts[kinds];
static long first_failing[kinds] = {-1, -1, -1, -1, -1, -1, -1};
static long last_failing[kinds] = {-1, -1, -1, -1, -1, -1, -1};
static int counts_file = -1;
static const char* after_read;
static atomic_int is_running;

extern void* __libc_malloc(size_t);
extern void* __libc_calloc(size_t, size_t);
extern void* __libc_realloc(void*, size_t);

static void begin(void) {
  const char* fault = getenv("FAULT");
  for (int kind = 0; fault && kind < kinds; ++kind) {
    const size_t length = strlen(names[kind]);
    if (strncmp(fault, names[kind], length) != 0 || fault[length] != ':') continue;
    char* rest;
    first_failing[kind] = strtol(fault + length + 1, &rest, 10);
    last_failing[kind] = *rest == '+' ? LONG_MAX : first_failing[kind];
  }
  const char* path = getenv("FAULT_COUNTS");
  if (path) counts_file = open(path, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  after_read = getenv("AFTER_READ");
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
  if (!is_running) return 0;
  const long number = atomic_fetch_add(&counts[kind], 1);
  if (number < first_failing[kind] || number > last_failing[kind]) return 0;
  errno = numbers[kind];
  return 1;
}

void* malloc(size_t size) { return fails(allocation) ? NULL : __libc_malloc(size); }
void* calloc(size_t count, size_t size) { return fails(allocation) ? NULL : __libc_calloc(count, size); }
void* realloc(void* block, size_t size) { return fails(allocation) ? NULL : __libc_realloc(block, size); }

int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*start)(void*), void* argument) {
  static int (*next)(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*);
  if (!next) next = (int (*)(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*))dlsym(RTLD_NEXT, "pthread_create");
  return fails(threading) ? EAGAIN : next(thread, attributes, start, argument);
}

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

ssize_t read(int file, void* bytes, size_t size) {
  static ssize_t (*next)(int, void*, size_t);
  if (!next) next = (ssize_t(*)(int, void*, size_t))dlsym(RTLD_NEXT, "read");
  const ssize_t count = next(file, bytes, size);
  struct stat status;
  if (is_running && after_read && fstat(file, &status) == 0 && S_ISREG(status.st_mode)) {
    const char* command = after_read;
    after_read = NULL;
    unsetenv("LD_PRELOAD");
    if (system(command) != 0) abort();
  }
  return count;
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
  struct stat status;
  const int kind = fstat(file, &status) == 0 && S_ISDIR(status.st_mode) ? syncing_folder : syncing;
  return fails(kind) ? -1 : next(file);
}

int rename(const char* from, const char* to) {
  static int (*next)(const char*, const char*);
  if (!next) next = (int (*)(const char*, const char*))dlsym(RTLD_NEXT, "rename");
  return fails(renaming) ? -1 : next(from, to);
}
