/* verify FILE|FOLDER...: prints the rules of a file, and of the certificates of a folder, and of the folders in it,
 * those that fail. Exit status: 0 if all are accepted, 1 if one is rejected, 2 if one is broken or cannot be read, or
 * there are none in a folder. */
#define _POSIX_C_SOURCE 200809L
#include "verify.h"
#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int worst = ACCEPTED, files = 0; /* the worst status of the files, and how many there were */

/* Reads a file behind `used` bytes of a block, which grows, and returns its size: -1 if it cannot be read. */
static long append_file(unsigned char **block, long used, const char *path) {
    FILE *file = fopen(path, "rb");
    if (file == NULL) return -1;
    long size = fseek(file, 0, SEEK_END) == 0 ? ftell(file) : -1;
    unsigned char *grown = size < 0 ? NULL : realloc(*block, (size_t)used + (size_t)size + 1);
    if (grown != NULL) *block = grown, rewind(file);
    if (grown == NULL || fread(grown + used, 1, (size_t)size, file) != (size_t)size) size = -1;
    fclose(file); return size;
}
/* Prints all rules, or those that fail, and the verdict. */
static void print_verdict(const char *path, int status, const Rule *rules, int all, int has_motion) {
    if (all) printf("%50s %18s %12s %11s %10s %8s\n", "unit", "claimed", "found", "difference", "tolerance", "step");
    for (int i = 0; i < RULES; i++) {
        const Rule *rule = &rules[i];
        if (!all && rule->difference <= rule->tolerance) continue;
        printf("%2d %-42s %-10s %12.6g %12.6g ", i + 1, rule->name, rule->unit, rule->claimed, rule->found);
        printf("%11.2g %10.0g %8ld ", rule->difference, rule->tolerance, rule->step);
        puts(rule->difference > rule->tolerance ? "FAILS" : rule->step < 0 ? "does not apply" : "");
    }
    const char *missing = has_motion ? "" : "; no motion file can be read: rules 1, 2 and half of 27 do not apply";
    printf("%s: %s%s\n", path, status == ACCEPTED ? "accepted" : "REJECTED", missing);
}
/* Verifies NAME.cert and NAME.npz beside it. */
static void verify_file(const char *path, int all_rules) {
    Rule rules[RULES]; const char *wrong = "cannot be read"; unsigned char *block = NULL; char motion_path[4096];
    snprintf(motion_path, sizeof motion_path, "%.*s.npz", (int)strlen(path) - 5, path);
    long size = append_file(&block, 0, path), motion_size = size < 0 ? -1 : append_file(&block, size, motion_path);
    const unsigned char *motion = motion_size < 0 ? NULL : block + size;
    int status = size < 0 ? BROKEN : verify_bytes(block, (size_t)size, motion, (size_t)motion_size, rules, &wrong);
    if (status == BROKEN) fprintf(stderr, "%s: %s\n", path, wrong);
    else print_verdict(path, status, rules, all_rules, motion != NULL);
    if (status > worst) worst = status;
    files++; free(block);
}
/* Verifies the certificates of a folder and of the folders in it. */
static void verify_folder(DIR *folder, const char *path) {
    for (struct dirent *entry = readdir(folder); entry != NULL; entry = readdir(folder)) {
        char name[4096]; const char *suffix = strrchr(entry->d_name, '.');
        snprintf(name, sizeof name, "%s/%s", path, entry->d_name);
        DIR *inner = entry->d_name[0] == '.' ? NULL : opendir(name);
        if (inner != NULL) verify_folder(inner, name);
        else if (suffix != NULL && strcmp(suffix, ".cert") == 0) verify_file(name, 0);
    }
    closedir(folder);
}

int main(int count, char **paths) {
    int help = count > 1 && strcmp(paths[1], "--help") == 0;
    if (count < 2 || help) return fprintf(stderr, "usage: verify FILE|FOLDER...\n"), help ? ACCEPTED : BROKEN;
    for (int i = 1; i < count; i++) {
        int before = files; DIR *folder = opendir(paths[i]);
        if (folder != NULL) verify_folder(folder, paths[i]);
        else verify_file(paths[i], 1);
        if (files == before) worst = BROKEN, fprintf(stderr, "%s: expected NAME.cert, found none\n", paths[i]);
    }
    return worst;
}
