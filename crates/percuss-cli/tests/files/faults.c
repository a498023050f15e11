/* Makes the Nth operation on files below a folder fail, or the process die there. Loaded before the C library (LD_PRELOAD).

   FAULT_UNDER  the folder, an absolute path; relative paths count as well
   FAULT_AT     number of the operation, from 1; 0 fails nothing
   FAULT_ERRNO  error of the system; 0 ends the process at once, a write half done
   FAULT_COUNT  file that the number of operations is written to at the end
   FAULT_NAMES  file that the path of every file and directory is written to that is to be made, a line each: F or D, and the path
   FAULT_PAUSE_AT  end of the path of a file before which the process waits, once it is to be made
   FAULT_GO     file that appears when it may go on; the same name and `.waiting` appears when it waits
   FAULT_THREADS  threads that may be started; further ones are refused as where too many processes run */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <sys/uio.h>
#include <unistd.h>

static atomic_long operations;

static long number(const char *name) {
  const char *text = getenv(name);
  return text ? strtol(text, 0, 10) : 0;
}

static int counts_path(const char *path) {
  const char *under = getenv("FAULT_UNDER");
  if (!under || !path) return 0;
  return path[0] != '/' || !strncmp(path, under, strlen(under));
}

static int counts_file(int file) {
  char link[64], path[4096];
  const char *under = getenv("FAULT_UNDER");
  if (!under) return 0;
  snprintf(link, sizeof link, "/proc/self/fd/%d", file);
  ssize_t length = readlink(link, path, sizeof path - 1);
  if (length <= 0) return 0;
  path[length] = 0;
  return !strncmp(path, under, strlen(under));
}

/* Whether this operation is the one; the process may end here. */
static int strikes(int may_die) {
  long own = atomic_fetch_add(&operations, 1) + 1;
  if (own != number("FAULT_AT")) return 0;
  long error = number("FAULT_ERRNO");
  if (!error && may_die) _exit(137);
  errno = error;
  return 1;
}

/* Waits before a file is made, until the test has done what it wants to do meanwhile. */
static void pause_at(const char *path) {
  const char *end = getenv("FAULT_PAUSE_AT"), *go = getenv("FAULT_GO");
  if (!end || !go || strlen(path) < strlen(end) || strcmp(path + strlen(path) - strlen(end), end)) return;
  char waiting[4096];
  snprintf(waiting, sizeof waiting, "%s.waiting", go);
  FILE *out = fopen(waiting, "w");
  if (out) fclose(out);
  for (int k = 0; k < 6000 && access(go, F_OK); k++) usleep(10000);
}

/* Notes a path that is to be made. */
static void note(char kind, int folder, const char *path) {
  pause_at(path);
  const char *file = getenv("FAULT_NAMES");
  if (!file || !counts_path(path)) return;
  char link[64], place[4096] = "";
  if (path[0] != '/') {
    snprintf(link, sizeof link, folder == AT_FDCWD ? "/proc/self/cwd" : "/proc/self/fd/%d", folder);
    ssize_t length = readlink(link, place, sizeof place - 2);
    if (length <= 0) return;
    place[length] = '/';
    place[length + 1] = 0;
  }
  FILE *out = fopen(file, "a");
  if (!out) return;
  fprintf(out, "%c %s%s\n", kind, place, path);
  fclose(out);
}

__attribute__((destructor)) static void tell(void) {
  const char *file = getenv("FAULT_COUNT");
  if (!file) return;
  unsetenv("FAULT_UNDER");
  FILE *out = fopen(file, "w");
  if (!out) return;
  fprintf(out, "%ld\n", (long)atomic_load(&operations));
  fclose(out);
}

#define REAL(name) static __typeof__(name) *real; if (!real) real = (__typeof__(name) *)dlsym(RTLD_NEXT, #name)

#define OPEN(name)                                                                    \
  int name(const char *path, int flags, ...) {                                        \
    REAL(name);                                     \
    va_list more; va_start(more, flags); mode_t mode = va_arg(more, mode_t); va_end(more); \
    if (flags & O_CREAT) note('F', AT_FDCWD, path);                                   \
    if (counts_path(path) && strikes(1)) return -1;                                   \
    return real(path, flags, mode);                                                   \
  }
OPEN(open)
OPEN(open64)

#define OPENAT(name)                                                                  \
  int name(int folder, const char *path, int flags, ...) {                            \
    REAL(name);                                \
    va_list more; va_start(more, flags); mode_t mode = va_arg(more, mode_t); va_end(more); \
    if (flags & O_CREAT) note('F', folder, path);                                     \
    if (counts_path(path) && strikes(1)) return -1;                                   \
    return real(folder, path, flags, mode);                                           \
  }
OPENAT(openat)
OPENAT(openat64)

ssize_t write(int file, const void *bytes, size_t count) {
  REAL(write);
  if (counts_file(file) && strikes(0)) {
    if (errno) return -1;
    real(file, bytes, count / 2);
    _exit(137);
  }
  return real(file, bytes, count);
}

ssize_t writev(int file, const struct iovec *pieces, int count) {
  REAL(writev);
  return counts_file(file) && strikes(1) ? -1 : real(file, pieces, count);
}

#define ON_FILE(name)                                                 \
  int name(int file) {                                                \
    REAL(name);                                        \
    return counts_file(file) && strikes(1) ? -1 : real(file);         \
  }
ON_FILE(fsync)
ON_FILE(fdatasync)

#define SHORTEN(name, length_type)                                    \
  int name(int file, length_type length) {                            \
    REAL(name);                           \
    return counts_file(file) && strikes(1) ? -1 : real(file, length); \
  }
SHORTEN(ftruncate, off_t)
SHORTEN(ftruncate64, off64_t)

#define ON_PATH(name)                                                 \
  int name(const char *path) {                                        \
    REAL(name);                               \
    return counts_path(path) && strikes(1) ? -1 : real(path);         \
  }
ON_PATH(unlink)
ON_PATH(rmdir)

int unlinkat(int folder, const char *path, int flags) {
  REAL(unlinkat);
  return counts_path(path) && strikes(1) ? -1 : real(folder, path, flags);
}

int mkdirat(int folder, const char *path, mode_t mode) {
  REAL(mkdirat);
  note('D', folder, path);
  return counts_path(path) && strikes(1) ? -1 : real(folder, path, mode);
}

int mkdir(const char *path, mode_t mode) {
  REAL(mkdir);
  note('D', AT_FDCWD, path);
  return counts_path(path) && strikes(1) ? -1 : real(path, mode);
}

#define TWO_PATHS(name)                                               \
  int name(const char *from, const char *to) {                        \
    REAL(name);                 \
    return counts_path(to) && strikes(1) ? -1 : real(from, to);       \
  }
TWO_PATHS(rename)
TWO_PATHS(link)

int linkat(int a, const char *from, int b, const char *to, int flags) {
  REAL(linkat);
  return counts_path(to) && strikes(1) ? -1 : real(a, from, b, to, flags);
}

int renameat(int a, const char *from, int b, const char *to) {
  REAL(renameat);
  return counts_path(to) && strikes(1) ? -1 : real(a, from, b, to);
}

int renameat2(int a, const char *from, int b, const char *to, unsigned flags) {
  REAL(renameat2);
  return counts_path(to) && strikes(1) ? -1 : real(a, from, b, to, flags);
}

static atomic_long threads;

int pthread_create(pthread_t *thread, const pthread_attr_t *how, void *(*work)(void *), void *with) {
  REAL(pthread_create);
  const char *most = getenv("FAULT_THREADS");
  if (most && atomic_fetch_add(&threads, 1) >= strtol(most, 0, 10)) return EAGAIN;
  return real(thread, how, work, with);
}
