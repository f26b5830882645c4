/* verify FILE|FOLDER...: prints the rules of a file, and one line per certificate of a folder.
 * Exit status: 0 if all are accepted, 1 if one is rejected, 2 if one is broken or cannot be read. */
#define _POSIX_C_SOURCE 200809L
#include "verify.h"
#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Where .cert begins in a path that ends with it, or NULL. */
static const char *suffix_of(const char *path) {
    const char *suffix = strrchr(path, '.');
    return suffix != NULL && strcmp(suffix, ".cert") == 0 ? suffix : NULL;
}
/* Opens NAME.npz beside NAME.cert, or returns NULL. */
static FILE *open_motion(const char *path) {
    char name[4096];
    const char *suffix = suffix_of(path);
    if (suffix == NULL || strlen(path) >= sizeof name) return NULL;
    snprintf(name, sizeof name, "%.*s.npz", (int)(suffix - path), path);
    return fopen(name, "rb");
}
/* The size of a file from its start, 0 if it cannot be told. */
static size_t size_of(FILE *file) {
    long size = file != NULL && fseek(file, 0, SEEK_END) == 0 ? ftell(file) : 0;
    if (size > 0) rewind(file);
    return size > 0 ? (size_t)size : 0;
}
/* Prints all rules. */
static void print_rules(const Rule *rules) {
    printf("%45s %-11s%12s %12s %11s %10s %8s\n", "", "unit", "claimed", "found", "difference", "tolerance", "step");
    for (int i = 0; i < RULES; i++) {
        const Rule *rule = &rules[i];
        printf("%2d %-42s %-10s ", i + 1, rule->name, rule->unit);
        printf("%12.6g %12.6g %11.2g %10.0g ", rule->claimed, rule->found, rule->difference, rule->tolerance);
        if (rule->step >= 0) printf("%8ld %s\n", rule->step, rule->difference <= rule->tolerance ? "" : "FAILS");
        else printf("  does not apply\n");
    }
}
/* Prints the verdict and the rules that fail, on one line. */
static void print_verdict(const char *path, int status, const Rule *rules, int has_motion) {
    printf("%s: %s", path, status == ACCEPTED ? "accepted" : "REJECTED");
    for (int i = 0; i < RULES; i++)
        if (!(rules[i].difference <= rules[i].tolerance))
            printf("; %d %s, step %ld", i + 1, rules[i].name, rules[i].step);
    printf("%s\n", has_motion ? "" : "; no motion file beside it, so rules 1, 2 and half of 27 do not apply");
}
/* Verifies one file, and returns its status. The certificate and its motion file share one block of memory. */
static int verify_file(const char *path, int all_rules) {
    Rule rules[RULES];
    const char *wrong = "cannot be read";
    FILE *file = fopen(path, "rb"), *motion = open_motion(path);
    size_t size = size_of(file), motion_size = size_of(motion);
    unsigned char *bytes = malloc(size + motion_size + 1), *at = motion != NULL && bytes != NULL ? bytes + size : NULL;
    int has_read = bytes != NULL && file != NULL && fread(bytes, 1, size, file) == size;
    if (has_read && at != NULL) has_read = fread(at, 1, motion_size, motion) == motion_size;
    int status = has_read ? verify_bytes(bytes, size, at, motion_size, rules, &wrong) : BROKEN;
    if (status == BROKEN) fprintf(stderr, "%s: %s\n", path, wrong);
    if (status != BROKEN && all_rules) print_rules(rules);
    if (status != BROKEN) print_verdict(path, status, rules, motion != NULL);
    if (file != NULL) fclose(file);
    if (motion != NULL) fclose(motion);
    free(bytes);
    return status;
}
/* Verifies the certificates of a folder, and returns the worst status. A path that is cut short cannot be read. */
static int verify_folder(DIR *folder, const char *name) {
    int worst = ACCEPTED;
    for (struct dirent *entry = readdir(folder); entry != NULL; entry = readdir(folder)) {
        char path[4096];
        snprintf(path, sizeof path, "%s/%s", name, entry->d_name);
        int status = suffix_of(entry->d_name) != NULL ? verify_file(path, 0) : ACCEPTED;
        if (status > worst) worst = status;
    }
    closedir(folder);
    return worst;
}

int main(int count, char **paths) {
    int worst = count < 2 ? BROKEN : ACCEPTED;
    if (count < 2) fprintf(stderr, "usage: verify FILE|FOLDER...\n");
    for (int i = 1; i < count; i++) {
        DIR *folder = opendir(paths[i]);
        int status = folder != NULL ? verify_folder(folder, paths[i]) : verify_file(paths[i], 1);
        if (status > worst) worst = status;
    }
    return worst;
}
