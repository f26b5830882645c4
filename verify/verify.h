/* Checks one certificate in memory. */
#pragma once
#include <stddef.h>

/* Rules, in the order of docs/certificate.md. */
enum { MOTION_FILE, FRAMES, CONSTANT, SHAPE, FINITE, UNIT, AXIS, POSITION, ROTATION, VELOCITY, SPIN, MEAN_VELOCITY,
    MEAN_SPIN, FORCE, MOMENT, JOINT, LAW, BOUND, AIR, NORMAL, SIDEWAYS, CONE, PULL, ABSENT, DEPTH, CLAIM, SCENE,
    RULES };

enum { ACCEPTED, REJECTED, BROKEN };

/* A rule and the step at which claimed and found differ most; -1: it never applied. */
typedef struct { const char *name, *unit; double tolerance, claimed, found, difference; long step; } Rule;

/* Fills rules[RULES] and returns ACCEPTED or REJECTED, or returns BROKEN and says in `wrong` what is wrong with the
 * file. `motion` is the motion file, or NULL: then that rule does not apply. */
int verify_bytes(const unsigned char *file, size_t size, const unsigned char *motion, size_t motion_size, Rule *rules,
                 const char **wrong);
