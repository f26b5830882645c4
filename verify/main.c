/* verify: checks certificates of motion.                                                     docs/certificate.md
 *
 *   verify FILE|FOLDER...     exit status: 0 all accepted, 1 one rejected, 2 one broken or not readable
 *
 * Where the motion file NAME.npz stands beside NAME.cert, it must be the one that the certificate binds. One block of
 * memory per certificate holds both files. */
#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "verify.h"

enum { LONGEST = 4096 };

static void report(const char *path, int status, const Rule *rules, int table) {
  int i;
  printf("%s: %s%s", path, status == ACCEPTED ? "accepted" : "rejected",
         rules[MOTION_FILE].step < 0 ? " without its motion file" : "");
  if (status == REJECTED)
    for (i = 0; i < RULES; ++i)
      if (rules[i].step >= 0 && !(rules[i].difference <= rules[i].tolerance)) {
        printf(": %s, step %ld", rules[i].name, rules[i].step);
        break;
      }
  printf("\n");
  if (!table && status == ACCEPTED) return;
  printf("  %-22s %-10s %14s %14s %12s %10s %9s\n", "rule", "unit", "claimed", "found", "difference", "tolerance", "step");
  for (i = 0; i < RULES; ++i)
    if (rules[i].step >= 0)
      printf("%s %-22s %-10s %14.6g %14.6g %12.3g %10.3g %9ld\n", rules[i].difference <= rules[i].tolerance ? " " : "!",
             rules[i].name, rules[i].unit, rules[i].claimed, rules[i].found, rules[i].difference, rules[i].tolerance,
             rules[i].step);
}

/* The size of a file, -1 if it cannot be read. */
static long size_of(const char *path) {
  long size = -1;
  FILE *in = fopen(path, "rb");
  if (in && !fseek(in, 0, SEEK_END)) size = ftell(in);
  if (in) fclose(in);
  return size;
}
static int read_all(const char *path, unsigned char *to, long size) {
  FILE *in = fopen(path, "rb");
  int good = in && fread(to, 1, (size_t)size, in) == (size_t)size;
  if (in) fclose(in);
  return good;
}

static int verify_file(const char *path, int table) {
  Rule rules[RULES];
  const char *wrong = "cannot be read";
  char motion[LONGEST];
  unsigned char *block = NULL;
  size_t end = strlen(path);
  long size = size_of(path), motion_size = -1;
  int status = BROKEN;
  if (end > 5 && end < sizeof motion && !strcmp(path + end - 5, ".cert")) {
    strcpy(motion, path), strcpy(motion + end - 5, ".npz");
    motion_size = size_of(motion);
  }
  if (size > 0) block = malloc((size_t)size + (motion_size > 0 ? (size_t)motion_size : 0));
  if (block && read_all(path, block, size) && (motion_size < 1 || read_all(motion, block + size, motion_size)))
    status = verify_bytes(block, (size_t)size, motion_size > 0 ? block + size : NULL,
                          motion_size > 0 ? (size_t)motion_size : 0, rules, &wrong);
  free(block);
  if (status == BROKEN) printf("%s: broken: %s\n", path, wrong);
  if (status != BROKEN) report(path, status, rules, table);
  return status;
}

int main(int count, char **arguments) {
  int i, found, any, status = ACCEPTED;
  char path[LONGEST];
  if (count < 2) {
    fprintf(stderr, "verify FILE|FOLDER...: checks certificates of motion, NAME.cert\n");
    return BROKEN;
  }
  for (i = 1; i < count; ++i) {
    DIR *folder = opendir(arguments[i]);
    struct dirent *entry;
    size_t here = strlen(arguments[i]), end;
    if (!folder) {
      found = verify_file(arguments[i], count == 2);
      status = found > status ? found : status;
      continue;
    }
    for (any = 0; (entry = readdir(folder)) != NULL;) {
      end = strlen(entry->d_name);
      if (end < 6 || strcmp(entry->d_name + end - 5, ".cert")) continue;
      any = 1, found = BROKEN;
      if (here + end + 2 > sizeof path)
        printf("%s/%s: broken: too long a path\n", arguments[i], entry->d_name);
      else
        strcpy(path, arguments[i]), strcat(strcat(path, "/"), entry->d_name), found = verify_file(path, 0);
      status = found > status ? found : status;
    }
    closedir(folder);
    if (!any) printf("%s: no certificates\n", arguments[i]), status = BROKEN;
  }
  return status;
}
