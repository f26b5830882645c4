/* Verifies a certificate of motion. The sections and rules named here are those of docs/certificate.md. */
#include "verify.h"
#include "tables.h"
#include <math.h>
#include <stdint.h>
#include <string.h>

typedef unsigned char Byte;

/* ---- Vectors and rotations: section "Format" ---- */
/* Negative numbers become zero. NaN stays, which fmax would lose. */
static double positive(double a) { return a < 0 ? 0 : a; }
static double limited(double a) { return a < 0 ? 0 : a > 1 ? 1 : a; }

static Vector vector(double x, double y, double z) { return (Vector){x, y, z}; }
static Vector plus(Vector a, Vector b) { return vector(a.x + b.x, a.y + b.y, a.z + b.z); }
static Vector minus(Vector a, Vector b) { return vector(a.x - b.x, a.y - b.y, a.z - b.z); }
static Vector times(Vector a, double s) { return vector(a.x * s, a.y * s, a.z * s); }
static Vector entrywise(Vector a, Vector b) { return vector(a.x * b.x, a.y * b.y, a.z * b.z); }
static Vector divided(Vector a, Vector b) { return vector(a.x / b.x, a.y / b.y, a.z / b.z); }
static double dot(Vector a, Vector b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static double length(Vector a) { return sqrt(dot(a, a)); }
static Vector cross(Vector a, Vector b) {
    return vector(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}
static Vector mirrored(Vector a) { return vector(-a.x, a.y, a.z); }
static double entry(Vector a, int axis) { return axis == 0 ? a.x : axis == 1 ? a.y : a.z; }
static Vector between(Vector a, Vector b, double share) { return plus(a, times(minus(b, a), share)); }

typedef struct { double w; Vector v; } Quaternion;

static double norm(Quaternion q) { return sqrt(q.w * q.w + dot(q.v, q.v)); }
static Quaternion inverse(Quaternion q) { return (Quaternion){q.w, times(q.v, -1)}; }
static Quaternion product(Quaternion a, Quaternion b) {
    Vector v = plus(plus(times(b.v, a.w), times(a.v, b.w)), cross(a.v, b.v));
    return (Quaternion){a.w * b.w - dot(a.v, b.v), v};
}
static Vector rotated(Quaternion q, Vector a) {
    Vector t = times(cross(q.v, a), 2);
    return plus(plus(a, times(t, q.w)), cross(q.v, t));
}

/* A quaternion that is too short to have a direction counts as no rotation. */
static Quaternion normalised(Quaternion q) {
    double size = norm(q);
    if (size < 1e-9) return (Quaternion){1, {0, 0, 0}};
    return (Quaternion){q.w / size, times(q.v, 1 / size)};
}

/* exp, of a rotation vector. */
static Quaternion rotation_by(Vector turn) {
    double angle = length(turn);
    if (angle == 0) return (Quaternion){1, {0, 0, 0}};
    return (Quaternion){cos(angle / 2), times(turn, sin(angle / 2) / angle)};
}

/* log, the vector of the shorter rotation. */
static Vector turn_of(Quaternion q) {
    double sine = length(q.v), angle = 2 * atan2(sine, fabs(q.w));
    if (sine == 0) return q.v;
    return times(q.v, (q.w < 0 ? -angle : angle) / sine);
}

/* The angle between two rotations. */
static double angle_between(Quaternion a, Quaternion b) { return length(turn_of(product(inverse(a), b))); }

/* ---- Bytes ---- */
/* Integers of the file are little-endian, whatever the machine is. */
static uint64_t integer_at(const Byte *at, int bytes) {
    uint64_t value = 0;
    for (int i = 0; i < bytes; i++) value |= (uint64_t)at[i] << (8 * i);
    return value;
}

static double number_at(const Byte *at) {
    union { uint64_t bits; double value; } number = {integer_at(at, 8)};
    return number.value;
}

static Vector vector_at(const Byte *at) { return vector(number_at(at), number_at(at + 8), number_at(at + 16)); }

/* SHA-256, FIPS 180-4: the constants of section 4.2.2. */
static const uint32_t HASH_CONSTANTS[64] = {
    0x428a2f98, 0x71374491, 0xb5c0fbcf, 0xe9b5dba5, 0x3956c25b, 0x59f111f1, 0x923f82a4, 0xab1c5ed5,
    0xd807aa98, 0x12835b01, 0x243185be, 0x550c7dc3, 0x72be5d74, 0x80deb1fe, 0x9bdc06a7, 0xc19bf174,
    0xe49b69c1, 0xefbe4786, 0x0fc19dc6, 0x240ca1cc, 0x2de92c6f, 0x4a7484aa, 0x5cb0a9dc, 0x76f988da,
    0x983e5152, 0xa831c66d, 0xb00327c8, 0xbf597fc7, 0xc6e00bf3, 0xd5a79147, 0x06ca6351, 0x14292967,
    0x27b70a85, 0x2e1b2138, 0x4d2c6dfc, 0x53380d13, 0x650a7354, 0x766a0abb, 0x81c2c92e, 0x92722c85,
    0xa2bfe8a1, 0xa81a664b, 0xc24b8b70, 0xc76c51a3, 0xd192e819, 0xd6990624, 0xf40e3585, 0x106aa070,
    0x19a4c116, 0x1e376c08, 0x2748774c, 0x34b0bcb5, 0x391c0cb3, 0x4ed8aa4a, 0x5b9cca4f, 0x682e6ff3,
    0x748f82ee, 0x78a5636f, 0x84c87814, 0x8cc70208, 0x90befffa, 0xa4506ceb, 0xbef9a3f7, 0xc67178f2};

/* Rotates to the right. */
static uint32_t rotate(uint32_t a, int bits) { return a >> bits | a << (32 - bits); }

/* Section 6.2.2: one block changes the hash. */
static void hash_block(uint32_t *hash, const Byte *block) {
    uint32_t w[64];
    for (int i = 0; i < 16; i++, block += 4)
        w[i] = (uint32_t)block[0] << 24 | (uint32_t)block[1] << 16 | (uint32_t)block[2] << 8 | block[3];
    for (int i = 16; i < 64; i++) {
        uint32_t old = w[i - 15], late = w[i - 2];
        w[i] = w[i - 16] + (rotate(old, 7) ^ rotate(old, 18) ^ old >> 3);
        w[i] += w[i - 7] + (rotate(late, 17) ^ rotate(late, 19) ^ late >> 10);
    }
    uint32_t a = hash[0], b = hash[1], c = hash[2], d = hash[3], e = hash[4], f = hash[5], g = hash[6], h = hash[7];
    for (int i = 0; i < 64; i++) {
        uint32_t first = h + (rotate(e, 6) ^ rotate(e, 11) ^ rotate(e, 25)) + ((e & f) ^ (~e & g));
        first += HASH_CONSTANTS[i] + w[i];
        uint32_t second = (rotate(a, 2) ^ rotate(a, 13) ^ rotate(a, 22)) + ((a & b) ^ (a & c) ^ (b & c));
        h = g, g = f, f = e, e = d + first;
        d = c, c = b, b = a, a = first + second;
    }
    const uint32_t change[8] = {a, b, c, d, e, f, g, h};
    for (int i = 0; i < 8; i++) hash[i] += change[i];
}

/* Says whether the bytes have the expected SHA-256. */
static int hash_is(const Byte *bytes, size_t size, const Byte *expected) {
    uint32_t hash[8] = {0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a, 0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
    Byte tail[128] = {0};
    size_t rest = size % 64, tail_size = rest < 56 ? 64 : 128;
    for (size_t i = 0; i < size / 64; i++) hash_block(hash, bytes + 64 * i);
    memcpy(tail, bytes + size - rest, rest);
    tail[rest] = 0x80;
    for (int i = 0; i < 8; i++) tail[tail_size - 1 - i] = (Byte)((uint64_t)size * 8 >> (8 * i));
    for (size_t i = 0; i < tail_size; i += 64) hash_block(hash, tail + i);
    for (int i = 0; i < 32; i++)
        if ((Byte)(hash[i / 4] >> (24 - i % 4 * 8)) != expected[i]) return 0;
    return 1;
}

/* ---- The file: section "Format" ---- */
enum { HEADER_SIZE = 5984, HASH_SIZE = 32, STEP_SIZE = 8 * STEP_NUMBERS, STATE_SIZE = 8 * STATE_NUMBERS };

/* A file of which nothing is broken. */
typedef struct { const Byte *bytes, *plates, *steps; long step_count, frame_steps; int plate_count; } File;

/* "A broken file": says what is wrong, or NULL. */
static const char *open_file(File *file, const Byte *bytes, size_t size) {
    if (size < 8 || memcmp(bytes, "MIMICERT", 8) != 0) return "not a certificate";
    if (size < HEADER_SIZE + STATE_SIZE + HASH_SIZE) return "shorter than a certificate";
    uint64_t start = integer_at(bytes + 12, 4), steps = integer_at(bytes + 24, 8);
    uint64_t frame_steps = integer_at(bytes + 32, 4), plates = integer_at(bytes + 36, 4);
    uint64_t points = integer_at(bytes + 40, 4), name = integer_at(bytes + 44, 4);
    if (integer_at(bytes + 8, 4) != 2) return "a version of the format other than 2";
    if (integer_at(bytes + 16, 8) != size) return "size differs from the recorded one";
    if (plates > MOST_PLATES) return "more than 64 plates";
    if (points != POINTS) return "another number of contact points";
    if (name < 1 || name > 4096) return "a name of no or too many bytes";
    if (start != HEADER_SIZE + 64 * plates + (name + 7) / 8 * 8)
        return "start of the steps differs from the length of the header";
    if (steps < 1 || steps > 1 << 24) return "no or too many steps";
    if (frame_steps < 1 || frame_steps > 240 || steps % frame_steps != 0) return "frames do not divide the steps";
    if (size != start + steps * STEP_SIZE + STATE_SIZE + HASH_SIZE) return "size differs from the number of steps";
    if (!hash_is(bytes, size - HASH_SIZE, bytes + size - HASH_SIZE)) return "hash differs";
    *file = (File){bytes, bytes + HEADER_SIZE, bytes + start, (long)steps, (long)frame_steps, (int)plates};
    return NULL;
}

/* ---- The body: section "Body" ---- */
/* All points within a radius of an axis. */
typedef struct { Vector end[2]; double radius; } Capsule;

/* It starts with the 24 numbers of "Format", in their order. Vectors are in the body's axes. */
typedef struct {
    Vector offset;
    double mass;
    Vector centre;
    double inertia[6], kp, kd, armature, bound;
    Capsule capsule;
    const Row *row;
    Vector range_width; /* 2 sin(half axes / 2) */
    Quaternion range_centre;
} Body;

/* A contact point: five numbers as in "Format". */
typedef struct { double body; Vector centre; double radius; } Point;
/* "Scales". */
typedef struct { double size, girth, foot, hand, head; } Scales;

static Scales scales_of(const double *beta) {
    double size = 1 + .03 * beta[0];
    return (Scales){size, size + .06 * beta[1], size + .04 * beta[7], size + .03 * beta[4], size + .04 * beta[8]};
}

/* "Offsets": the scaled offset of a row. */
static Vector scaled_offset(const Row *row, const double *beta) {
    Vector growth = times(vector(1, 1, 1), scales_of(beta).size);
    for (int i = 0; i < COUNT(GAINS); i++)
        if (GAINS[i].part == row->part) growth = plus(growth, times(GAINS[i].gain, beta[GAINS[i].beta]));
    return entrywise(row->offset, growth);
}

/* "Capsules", of the trunk, the head and the left side. */
static void set_capsules(Body *bodies, Scales s) {
    for (int i = 0; i < COUNT(TRUNK); i++) {
        Vector left = times(TRUNK[i].end, s.size);
        bodies[TRUNK[i].body].capsule = (Capsule){{mirrored(left), left}, TRUNK[i].radius * s.girth};
    }
    for (int i = 0; i < COUNT(BONES); i++) {
        Vector bone = bodies[BONES[i].child].offset, from = times(bone, BONES[i].from), to = times(bone, BONES[i].to);
        bodies[BONES[i].body].capsule = (Capsule){{from, to}, BONES[i].radius * s.girth};
    }
    Capsule *thigh = &bodies[1].capsule;
    thigh->radius = fmin(thigh->radius, fabs(bodies[1].offset.x + thigh->end[0].x) - .001);
    bodies[15].capsule = (Capsule){{{0, .03 * s.head, 0}, {0, .105 * s.head, 0}}, .085 * s.head};
    Vector ball = bodies[10].offset;
    double y = .034 * s.size - (.022 - ball.y), toe = .020 * s.size - .022;
    bodies[7].capsule = (Capsule){{{0, y, -.022 * s.foot}, {ball.x, y, ball.z - .014 * s.foot}}, .034 * s.size};
    bodies[10].capsule = (Capsule){{{0, toe, .012 * s.foot}, {0, toe, .052 * s.foot}}, .020 * s.size};
    bodies[20].capsule = (Capsule){{{.03 * s.hand, -.004, 0}, {.14 * s.hand, -.010, .004}}, .030 * s.hand};
}

/* Rows, offsets and capsules of all bodies. The right side is the mirror image of the left. */
static void build_skeleton(Body *bodies, const double *beta) {
    for (int i = 0; i < COUNT(ROWS); i++) {
        bodies[ROWS[i].body].row = &ROWS[i];
        bodies[ROWS[i].body].offset = scaled_offset(&ROWS[i], beta);
    }
    set_capsules(bodies, scales_of(beta));
    for (int i = 0; i < BODIES; i++) {
        if (LEFT_OF[i] == i) continue;
        Body *body = &bodies[i];
        *body = bodies[LEFT_OF[i]];
        body->offset = mirrored(body->offset);
        for (int k = 0; k < 2; k++) body->capsule.end[k] = mirrored(body->capsule.end[k]);
    }
}

/* "Mass": pi is the same in every volume. */
static double volume_over_pi(Capsule capsule) {
    double height = length(minus(capsule.end[1], capsule.end[0]));
    return capsule.radius * capsule.radius * (height + 4 * capsule.radius / 3);
}

/* "Inertia". */
static void set_inertia(Body *body) {
    Vector axis = minus(body->capsule.end[1], body->capsule.end[0]);
    double h = length(axis), r = body->capsule.radius;
    double cylinder = body->mass * h / (h + 4 * r / 3), balls = body->mass - cylinder;
    double along = (cylinder / 2 + 2 * balls / 5) * r * r;
    double across = cylinder * (h * h / 12 + r * r / 4) + balls * (2 * r * r / 5 + h * h / 4 + 3 * h * r / 8);
    Vector u = times(axis, 1 / h), part = times(u, along - across);
    const double entries[6] = {across + part.x * u.x, part.x * u.y, part.x * u.z,
                               across + part.y * u.y, part.y * u.z, across + part.z * u.z};
    memcpy(body->inertia, entries, sizeof entries);
}

/* "Joints" and "Range". The side of a right body is -1. */
static void set_joint(Body *body, double side, double strength) {
    const Row *row = body->row;
    const Vector mirror = {1, side, side};
    Vector half = times(row->range_half, PI / 360);
    body->kp = row->kp * strength;
    body->kd = body->kp / 10;
    body->bound = row->bound * strength;
    body->armature = row->armature;
    body->range_centre = rotation_by(times(entrywise(row->range_centre, mirror), PI / 180));
    body->range_width = times(vector(sin(half.x), sin(half.y), sin(half.z)), 2);
}

/* The body of a shape. */
static void build_body(Body *bodies, const double *beta) {
    static const double MEAN_SHAPE[SHAPES] = {0};
    Body mean[BODIES];
    double whole = 0;
    build_skeleton(mean, MEAN_SHAPE);
    build_skeleton(bodies, beta);
    for (int i = 0; i < BODIES; i++) {
        Body *body = &bodies[i];
        body->mass = 70 * body->row->share * volume_over_pi(body->capsule) / volume_over_pi(mean[i].capsule);
        body->centre = between(body->capsule.end[0], body->capsule.end[1], 0.5);
        set_inertia(body);
        whole += body->mass;
    }
    for (int i = 0; i < BODIES; i++) set_joint(&bodies[i], LEFT_OF[i] == i ? 1 : -1, whole / 70);
}

/* The mirror image of a point of the left foot. */
static Point mirrored_point(Point left) { return (Point){left.body + 1, mirrored(left.centre), left.radius}; }

/* "Contact points": a left foot and its mirror image, the insteps, and spheres on the axes of capsules. */
static void set_points(Point *points, const Body *bodies, Scales s) {
    Vector ball = bodies[10].offset, half = {.040 * s.size, 0, 0};
    double heel = .026 * s.size, toe = .030 * s.size, sole = ball.y - .022;
    points[0] = (Point){7, {-heel, sole, -.052 * s.foot}, 0};
    points[1] = (Point){7, {heel, sole, -.052 * s.foot}, 0};
    points[2] = (Point){7, minus(ball, half), .022};
    points[3] = (Point){7, plus(ball, half), .022};
    points[4] = (Point){10, {-toe, -.022, .068 * s.foot}, 0};
    points[5] = (Point){10, {toe, -.022, .062 * s.foot}, 0};
    for (int i = 6; i < 12; i++) points[i] = mirrored_point(points[i - 6]);
    points[12] = (Point){7, {ball.x, sole + .036 * s.size, .6 * ball.z}, .026 * s.size};
    points[13] = mirrored_point(points[12]);
    for (int i = 0; i < COUNT(SPHERES); i++) {
        Capsule capsule = bodies[SPHERES[i].body].capsule;
        Vector centre = between(capsule.end[0], capsule.end[1], SPHERES[i].share);
        points[14 + i] = (Point){SPHERES[i].body, centre, capsule.radius};
    }
}

/* ---- Rules, and reading the certificate's numbers ---- */
/* A plate of the scene; also the floor, which has no sides. */
typedef struct { double x, y, cosine, sine, half_first, half_second, height, k, c; } Plate;

/* Numbers of a member of the motion file, and how many members have its name. */
typedef struct { const Byte *numbers; uint64_t rows, columns; int members; } Array;

/* What the rules of all steps share. */
typedef struct {
    File file;
    Rule *rules;
    long step; /* the one that is looked at */
    double beta[SHAPES], claims[CLAIMS];
    Body bodies[BODIES];
    Point points[POINTS];
    Plate plates[1 + MOST_PLATES]; /* the floor, then the file's */
    Array poses, places;
    double speed_sum, spin_sum, push, beyond, pull, absent, deepest, effort;
} Check;

/* Keeps the largest difference of a rule. NaN counts as infinite. */
static void note(Check *check, int index, double claimed, double found, double difference) {
    Rule *rule = &check->rules[index];
    if (!(difference < INFINITY)) difference = INFINITY;
    if (rule->step >= 0 && difference <= rule->difference) return;
    *rule = (Rule){rule->name, rule->unit, rule->tolerance, claimed, found, difference, check->step};
}

/* For what should be equal, and for what should be nothing. */
static void compare(Check *check, int rule, double a, double b) { note(check, rule, a, b, fabs(a - b)); }
static void excess(Check *check, int rule, double found) { note(check, rule, 0, found, found); }

/* Reads numbers into a structure of doubles. Rule 5: a number that fails counts as 0. */
static void read_numbers(Check *check, const Byte *from, int count, void *to) {
    for (int i = 0; i < count; i++) {
        double number = number_at(from + 8 * i);
        if (!(fabs(number) < 1e9)) {
            excess(check, FINITE, 1);
            number = 0;
        }
        memcpy((Byte *)to + i * (int)sizeof number, &number, sizeof number);
    }
}

/* Rules 3 and 4. The laws below use the body that is built here, not the recorded one. */
static void check_header(Check *check) {
    const double constants[] = {RATE, GRAVITY, FLOOR_K, FLOOR_C, FRICTION, SLIP_SPEED,
                                SKIN, SELF_K,  SELF_C,  RANGE_K, RANGE_C};
    double claimed[HEADER_NUMBERS], found[HEADER_NUMBERS];
    read_numbers(check, check->file.bytes + 80, HEADER_NUMBERS, claimed);
    memcpy(check->beta, claimed + FIRST_SHAPE, sizeof check->beta);
    memcpy(check->claims, claimed + FIRST_CLAIM, sizeof check->claims);
    build_body(check->bodies, check->beta);
    set_points(check->points, check->bodies, scales_of(check->beta));
    memcpy(found, claimed, sizeof found);
    memcpy(found, constants, sizeof constants);
    for (int i = 0; i < BODIES; i++)
        memcpy(found + FIRST_BODY + i * BODY_NUMBERS, &check->bodies[i], BODY_NUMBERS * sizeof found[0]);
    memcpy(found + FIRST_POINT, check->points, sizeof check->points);
    for (int i = 0; i < HEADER_NUMBERS; i++) compare(check, i < FIRST_SHAPE ? CONSTANT : SHAPE, claimed[i], found[i]);
    for (int i = 0; i < SHAPES; i++) excess(check, SHAPE, positive(fabs(check->beta[i]) - 5));
}

/* Rule 27: numbers of plates in their ranges. */
static void check_plates(Check *check) {
    check->plates[0] = (Plate){.k = FLOOR_K, .c = FLOOR_C};
    note(check, SCENE, check->file.plate_count, check->file.plate_count, 0);
    for (int i = 0; i < check->file.plate_count; i++) {
        double n[PLATE_NUMBERS];
        read_numbers(check, check->file.plates + 64 * i, PLATE_NUMBERS, n);
        for (int k = 0; k < PLATE_NUMBERS; k++)
            if (!(n[k] >= PLATE_RANGE[k][0] && n[k] <= PLATE_RANGE[k][1])) excess(check, SCENE, INFINITY);
        check->plates[i + 1] = (Plate){n[0], n[1], cos(n[2]), sin(n[2]), n[3], n[4], n[5], n[6], n[7]};
    }
}

/* ---- The motion file: rules 1, 2 and 27 ---- */
/* Reads the sizes of an array and the rest of the text. A size that is missing is 1. Returns 0 for any other text. */
static int read_shape(const Byte *at, const Byte *end, uint64_t *sizes) {
    int dimension = 0, digits = 0;
    for (; at < end && *at != ')'; at++) {
        if (*at == ',') {
            dimension++;
            digits = 0;
        } else if (*at >= '0' && *at <= '9' && dimension < 2 && digits < 9) {
            sizes[dimension] = (digits == 0 ? 0 : 10 * sizes[dimension]) + (*at - '0');
            digits++;
        } else if (*at != ' ') {
            return 0;
        }
    }
    if (end - at < 4 || memcmp(at, "), }", 4) != 0) return 0;
    for (at += 4; at < end; at++)
        if (*at != ' ' && *at != '\n') return 0;
    return 1;
}

/* Reads a member as an array of NumPy, which has no numbers if it has another form. */
static Array read_array(const Byte *member, uint64_t size, int members) {
    static const char START[] = "{'descr': '<f8', 'fortran_order': False, 'shape': (";
    const uint64_t start = 10 + sizeof START - 1, header = size < 10 ? 0 : 10 + integer_at(member + 8, 2);
    uint64_t sizes[2] = {1, 1};
    Array array = {NULL, 0, 0, members};
    if (header < start || header > size || memcmp(member, "\x93NUMPY\1\0", 8) != 0) return array;
    if (memcmp(member + 10, START, sizeof START - 1) != 0) return array;
    if (!read_shape(member + start, member + header, sizes)) return array;
    if (sizes[0] * sizes[1] * 8 != size - header) return array;
    return (Array){member + header, sizes[0], sizes[1], members};
}

/* Finds NAME.npy from the front of the zip; NumPy takes NAME for the same. If it is there twice it has no numbers. */
static Array find_array(const Byte *zip, size_t size, const char *name) {
    Array found = {NULL, 0, 0, 0};
    size_t length = strlen(name);
    for (uint64_t at = 0; size - at >= 30 && memcmp(zip + at, "PK\3\4", 4) == 0;) {
        uint64_t flags = integer_at(zip + at + 6, 2), method = integer_at(zip + at + 8, 2);
        uint64_t data_size = integer_at(zip + at + 22, 4), name_size = integer_at(zip + at + 26, 2);
        uint64_t data = at + 30 + name_size + integer_at(zip + at + 28, 2);
        if ((flags & 8) != 0 || method != 0 || data + data_size > size) break;
        int length_fits = name_size == length || name_size == length - strlen(".npy");
        if (length_fits && memcmp(zip + at + 30, name, (size_t)name_size) == 0)
            found = read_array(zip + data, data_size, found.members + 1);
        at = data + data_size;
    }
    if (found.members > 1) found.numbers = NULL;
    return found;
}

/* Whether an array was found and has so many numbers. */
static int has_numbers(Array array, uint64_t least, uint64_t most) {
    return array.numbers != NULL && array.rows * array.columns >= least && array.rows * array.columns <= most;
}

/* Rule 27: the plates are those of the motion file, which has none for the flat floor. */
static void check_scene(Check *check, Array plates) {
    uint64_t count = PLATE_NUMBERS * (uint64_t)check->file.plate_count;
    int same = count == 0 && plates.members == 0;
    if (count > 0 && has_numbers(plates, count, count))
        same = memcmp(plates.numbers, check->file.plates, 8 * (size_t)count) == 0;
    double found = (double)(plates.rows * plates.columns) / PLATE_NUMBERS;
    note(check, SCENE, check->file.plate_count, found, same ? 0 : INFINITY);
}

/* Rules 1 and 2. The frames are compared when their states are read. */
static void check_motion_file(Check *check, const Byte *zip, size_t size) {
    uint64_t frames = (uint64_t)(check->file.step_count / check->file.frame_steps + 1);
    Array poses = find_array(zip, size, "poses.npy"), places = find_array(zip, size, "trans.npy");
    Array beta = find_array(zip, size, "betas.npy"), rate = find_array(zip, size, "mocap_framerate.npy");
    int frames_known = has_numbers(poses, 1, size) && poses.rows == frames && poses.columns >= 3 * BODIES &&
                       has_numbers(places, 1, size) && places.rows == frames && places.columns == 3;
    excess(check, MOTION_FILE, !hash_is(zip, size, check->file.bytes + 48));
    check_scene(check, find_array(zip, size, "scene_plates.npy"));
    if (!frames_known || !has_numbers(beta, SHAPES, size) || !has_numbers(rate, 1, 1)) {
        excess(check, FRAMES, INFINITY);
        return;
    }
    compare(check, FRAMES, number_at(rate.numbers), RATE / check->file.frame_steps);
    for (int i = 0; i < SHAPES; i++) compare(check, FRAMES, number_at(beta.numbers + 8 * i), check->beta[i]);
    check->poses = poses;
    check->places = places;
}

/* ---- States and steps ---- */
/* The numbers of a state and of a step, in the order of "Format". Arrays of joints begin with joint 1. */
typedef struct { Vector place; Quaternion turn[BODIES]; Vector speed, spin[BODIES]; } State;
typedef struct {
    State now;
    Vector speed_after, spin_after[BODIES];
    Quaternion target[JOINTS];
    Vector target_spin[JOINTS], torque[JOINTS], force[POINTS];
} Step;

/* How fast the angular velocity of a body changes in a step. */
static Vector spin_rate(const Step *step, int i) { return times(minus(step->spin_after[i], step->now.spin[i]), RATE); }

/* Rule 2 for the state of a frame. */
static void check_frame(Check *check, const State *state) {
    const Vector pelvis = {.003, -.351, .012};
    size_t frame = check->step / check->file.frame_steps;
    const Byte *pose = check->poses.numbers + 8 * frame * (size_t)check->poses.columns;
    Vector place = plus(vector_at(check->places.numbers + 24 * frame), pelvis);
    excess(check, FRAMES, length(minus(place, state->place)));
    for (int i = 0; i < BODIES; i++) {
        Quaternion turn = rotation_by(vector_at(pose + 24 * i));
        excess(check, FRAMES, angle_between(turn, state->turn[i]));
    }
}

/* Reads a state, and normalises its quaternions. Rules 6 and 7, and 2 if it is a frame's. */
static void read_state(Check *check, long step, State *state) {
    check->step = step;
    read_numbers(check, check->file.steps + (size_t)step * STEP_SIZE, STATE_NUMBERS, state);
    for (int i = 0; i < BODIES; i++) {
        int hinge = check->bodies[i].row->hinge;
        compare(check, UNIT, norm(state->turn[i]), 1);
        state->turn[i] = normalised(state->turn[i]);
        for (int axis = 0; axis < 3; axis++) {
            if (hinge < 0 || axis == hinge) continue;
            excess(check, AXIS, fabs(2 * entry(state->turn[i].v, axis)));
            excess(check, AXIS, fabs(entry(state->spin[i], axis)));
        }
    }
    if (check->poses.numbers != NULL && step % check->file.frame_steps == 0) check_frame(check, state);
}

/* Rules 8 to 11, and the sums of 12 and 13: "Integration". */
static void check_integration(Check *check, const Step *step, const State *next) {
    Vector place = plus(step->now.place, times(next->speed, 1 / RATE));
    double speed_error = length(minus(next->speed, step->speed_after));
    excess(check, POSITION, length(minus(next->place, place)));
    excess(check, VELOCITY, speed_error);
    check->speed_sum += speed_error;
    for (int i = 0; i < BODIES; i++) {
        Quaternion turn = product(step->now.turn[i], rotation_by(times(next->spin[i], 1 / RATE)));
        double spin_error = length(minus(next->spin[i], step->spin_after[i]));
        excess(check, ROTATION, angle_between(turn, next->turn[i]));
        excess(check, SPIN, spin_error);
        check->spin_sum += spin_error;
    }
}

/* Rules 17 and 18: "Controller", whose law is kp phi + kd omega* - (kd + dt kp) omega', as omega' = omega + dt rate. */
static void check_controllers(Check *check, const Step *step) {
    for (int i = 0; i < JOINTS; i++) {
        const Body *body = &check->bodies[i + 1];
        Vector phi = turn_of(product(inverse(step->now.turn[i + 1]), normalised(step->target[i])));
        Vector spring = plus(times(phi, body->kp), times(step->target_spin[i], body->kd));
        Vector law = minus(spring, times(step->spin_after[i + 1], body->kd + body->kp / RATE));
        double torque = length(step->torque[i]);
        int at_bound = fabs(torque - body->bound) <= 1e-9 * body->bound;
        if (!at_bound) excess(check, LAW, length(minus(step->torque[i], law)));
        excess(check, BOUND, positive(torque / body->bound - 1));
        check->effort = fmax(check->effort, torque / body->bound);
    }
}

/* ---- The laws of mechanics: section "The laws" ---- */
/* How a body turns, and how its joint or another point of it moves, in world axes. */
typedef struct { Vector place, speed, acceleration, spin, spin_rate; Quaternion turn; } Motion;

/* What a joint carries of the outer bodies: a force, and a moment about the joint, in world axes. */
typedef struct { Vector force, moment; } Load;

/* The motion of the point of a body that is at an arm from its joint. */
static Motion point_of(const Motion *body, Vector arm) {
    Motion point = *body;
    Vector swing = cross(body->spin, arm);
    point.place = plus(body->place, arm);
    point.speed = plus(body->speed, swing);
    point.acceleration = plus(body->acceleration, plus(cross(body->spin_rate, arm), cross(body->spin, swing)));
    return point;
}

/* The joint of a body carries one more force, which is needed at a place. */
static void carry(Load *load, const Motion *body, Vector place, Vector force) {
    load->force = plus(load->force, force);
    load->moment = plus(load->moment, cross(minus(place, body->place), force));
}

/* "Motion of the bodies", from the pelvis outwards. A body starts from its parent's motion. */
static void find_motions(const Check *check, const Step *step, Motion *motions) {
    const State *now = &step->now;
    const Vector none = {0, 0, 0}, acceleration = times(minus(step->speed_after, now->speed), RATE);
    motions[0] = (Motion){now->place, now->speed, acceleration, none, none, {1, none}};
    for (int i = 0; i < BODIES; i++) {
        Motion *body = &motions[i], *parent = &motions[i == 0 ? 0 : PARENT[i]];
        if (i > 0) *body = point_of(parent, rotated(parent->turn, check->bodies[i].offset));
        body->turn = product(body->turn, now->turn[i]);
        Vector spin = rotated(body->turn, now->spin[i]), rate = rotated(body->turn, spin_rate(step, i));
        body->spin_rate = plus(body->spin_rate, plus(rate, cross(body->spin, spin)));
        body->spin = plus(body->spin, spin);
    }
}

/* "Ground": whether a plate has a point. */
static int plate_has(const Plate *plate, Vector place) {
    double x = place.x - plate->x, y = place.y - plate->y, z = place.z - plate->height;
    double first = plate->cosine * x + plate->sine * y, second = plate->cosine * y - plate->sine * x;
    int inside = fabs(first) <= plate->half_first && fabs(second) <= plate->half_second;
    return inside && z > -PLATE_REACH && z < SKIN + FIRST_TOUCH;
}

/* "Ground": the plate that counts under a point. The floor is lower than all plates. */
static const Plate *ground_under(const Check *check, Vector place) {
    const Plate *ground = check->plates;
    for (const Plate *plate = ground + 1; plate <= check->plates + check->file.plate_count; plate++)
        if (plate->height > ground->height && plate_has(plate, place)) ground = plate;
    return ground;
}

/* Rule 21: the part of the friction that is not against the slip. */
static double astray(Vector friction, Vector slip) {
    double speed = length(slip);
    if (speed == 0) return length(friction);
    return length(cross(slip, friction)) / speed + positive(dot(slip, friction) / speed);
}

/* Rules 19 to 25 for the touching place of a point. */
static void check_touch(Check *check, const Motion *touch, Vector force) {
    const Plate *ground = ground_under(check, touch->place);
    double depth = ground->height - touch->place.z, overlap = depth + SKIN;
    check->deepest = fmax(check->deepest, depth);
    if (ground == check->plates) excess(check, DEPTH, positive(depth));
    else overlap = fmin(overlap, PLATE_PUSH / ground->k);
    if (!(overlap > -FIRST_TOUCH)) {
        excess(check, AIR, length(force));
        return;
    }
    Vector after = plus(touch->speed, times(touch->acceleration, 1 / RATE));
    Vector friction = {force.x, force.y, 0}, slip = {after.x, after.y, 0};
    double law = ground->k * positive(overlap) - (ground->c + ground->k / RATE) * after.z;
    if (force.x == 0 && force.y == 0 && force.z == 0) {
        if (overlap > 0) check->absent += positive(law);
        return;
    }
    compare(check, NORMAL, force.z, law);
    excess(check, SIDEWAYS, astray(friction, slip));
    check->push += positive(force.z);
    check->pull += positive(-force.z);
    check->beyond += positive(length(friction) - FRICTION * positive(force.z));
}

/* "Ground": checks its forces. The joints need not carry them. */
static void check_ground(Check *check, const Step *step, const Motion *motions, Load *carried) {
    for (int i = 0; i < POINTS; i++) {
        const Point *point = &check->points[i];
        const Motion *body = &motions[(int)point->body];
        Vector arm = minus(rotated(body->turn, point->centre), vector(0, 0, point->radius));
        Motion touch = point_of(body, arm);
        check_touch(check, &touch, step->force[i]);
        carry(&carried[(int)point->body], body, touch.place, times(step->force[i], -1));
    }
}

/* "Closest points", of the axes of two bodies' capsules. */
static void find_closest(const Check *check, const Motion *motions, int one, int two, Vector *c1, Vector *c2) {
    const Vector *first = check->bodies[one].capsule.end, *second = check->bodies[two].capsule.end;
    Vector p = plus(motions[one].place, rotated(motions[one].turn, first[0]));
    Vector q = plus(motions[two].place, rotated(motions[two].turn, second[0]));
    Vector u = rotated(motions[one].turn, minus(first[1], first[0]));
    Vector w = rotated(motions[two].turn, minus(second[1], second[0])), d = minus(p, q);
    double a = fmax(dot(u, u), 1e-9), e = fmax(dot(w, w), 1e-9);
    double b = dot(u, w), c = dot(u, d), f = dot(w, d);
    double s = limited((b * f - c * e) / fmax(a * e - b * b, 1e-9)), t = (b * s + f) / e;
    if (!(t >= 0 && t <= 1)) {
        t = limited(t);
        s = limited((b * t - c) / a);
    }
    *c1 = plus(p, times(u, s));
    *c2 = plus(q, times(w, t));
}

/* "Self contact", of all pairs. The joints need not carry its forces. */
static void add_self_contact(const Check *check, const Motion *motions, Load *carried) {
    for (int i = 0; i < COUNT(PAIRS); i++) {
        int one = PAIRS[i].first, two = PAIRS[i].second;
        double radius = check->bodies[one].capsule.radius, other_radius = check->bodies[two].capsule.radius;
        Vector c1, c2;
        find_closest(check, motions, one, two, &c1, &c2);
        double distance = fmax(length(minus(c1, c2)), 1e-6), overlap = radius + other_radius - distance;
        if (overlap <= 0) continue;
        Vector normal = times(minus(c1, c2), 1 / distance);
        Vector place = plus(c2, times(normal, other_radius - overlap / 2));
        Vector speed = point_of(&motions[one], minus(place, motions[one].place)).speed;
        Vector other_speed = point_of(&motions[two], minus(place, motions[two].place)).speed;
        double push = positive(SELF_K * overlap - SELF_C * dot(minus(speed, other_speed), normal));
        carry(&carried[one], &motions[one], place, times(normal, -push));
        carry(&carried[two], &motions[two], place, times(normal, push));
    }
}

/* An inertia (xx, xy, xz, yy, yz, zz) times a vector. */
static Vector inertia_times(const double *i, Vector a) {
    return vector(i[0] * a.x + i[1] * a.y + i[2] * a.z, i[1] * a.x + i[3] * a.y + i[4] * a.z,
                  i[2] * a.x + i[4] * a.y + i[5] * a.z);
}

/* "Newton, Euler": what a body needs for its motion, in spite of gravity. */
static void add_inertia(const Body *body, const Motion *motion, Load *carried) {
    Motion centre = point_of(motion, rotated(motion->turn, body->centre));
    Vector force = times(plus(centre.acceleration, vector(0, 0, GRAVITY)), body->mass);
    Vector spin = rotated(inverse(motion->turn), motion->spin);
    Vector rate = rotated(inverse(motion->turn), motion->spin_rate);
    Vector moment = plus(inertia_times(body->inertia, rate), cross(spin, inertia_times(body->inertia, spin)));
    carry(carried, motion, centre.place, force);
    carried->moment = plus(carried->moment, rotated(motion->turn, moment));
}

/* "Range": the torque on a joint that is beyond its range. */
static Vector range_torque(const Body *body, Quaternion turn, Vector spin_after) {
    Quaternion q = product(inverse(body->range_centre), turn);
    Vector s = divided(times(q.v, q.w < 0 ? -2 : 2), body->range_width), d = divided(s, body->range_width);
    double g = length(s);
    if (g <= 1) return vector(0, 0, 0);
    Vector spring = times(d, RANGE_K * (g - 1) * g / dot(d, d));
    return times(plus(spring, times(spin_after, RANGE_C + RANGE_K / RATE)), -1);
}

/* Rule 16: "Joint". */
static void check_joint(Check *check, const Step *step, int i, Vector carried) {
    const Body *body = &check->bodies[i];
    Vector torque = plus(step->torque[i - 1], range_torque(body, step->now.turn[i], step->spin_after[i]));
    Vector difference = minus(carried, minus(torque, times(spin_rate(step, i), body->armature)));
    excess(check, JOINT, body->row->hinge < 0 ? length(difference) : fabs(entry(difference, body->row->hinge)));
}

/* Rules 14 to 16, from the outer bodies inwards. The pelvis has no joint: nothing may be left there. */
static void check_mechanics(Check *check, const Step *step, const Motion *motions, Load *carried) {
    for (int i = BODIES - 1; i > 0; i--) {
        Load *parent = &carried[PARENT[i]];
        add_inertia(&check->bodies[i], &motions[i], &carried[i]);
        check_joint(check, step, i, rotated(inverse(motions[i].turn), carried[i].moment));
        carry(parent, &motions[PARENT[i]], motions[i].place, carried[i].force);
        parent->moment = plus(parent->moment, carried[i].moment);
    }
    add_inertia(&check->bodies[0], &motions[0], &carried[0]);
    excess(check, FORCE, length(carried[0].force));
    excess(check, MOMENT, length(carried[0].moment));
}

/* ---- The whole motion ---- */
/* Rules 8 to 25 for a step. */
static void check_step(Check *check, const Step *step, const State *next) {
    Motion motions[BODIES];
    Load carried[BODIES];
    memset(carried, 0, sizeof carried);
    check_integration(check, step, next);
    check_controllers(check, step);
    find_motions(check, step, motions);
    check_ground(check, step, motions, carried);
    add_self_contact(check, motions, carried);
    check_mechanics(check, step, motions, carried);
}

/* All states and steps. */
static void check_steps(Check *check) {
    Step step;
    State now, next;
    read_state(check, 0, &now);
    for (long i = 0; i < check->file.step_count; i++) {
        read_state(check, i + 1, &next);
        check->step = i;
        read_numbers(check, check->file.steps + (size_t)i * STEP_SIZE, STEP_NUMBERS, &step);
        step.now = now;
        check_step(check, &step, &next);
        now = next;
    }
}

/* Rules 12, 13 and 22 to 26. */
static void check_totals(Check *check) {
    double steps = check->file.step_count, push = check->push < 1 ? 1 : check->push;
    const double found[CLAIMS] = {check->effort, check->beyond / push, check->pull / push, check->deepest};
    check->step = 0;
    excess(check, MEAN_VELOCITY, check->speed_sum / steps);
    excess(check, MEAN_SPIN, check->spin_sum / steps / BODIES);
    note(check, CONE, check->claims[1], found[1], found[1]);
    note(check, PULL, check->claims[2], found[2], found[2]);
    excess(check, ABSENT, check->absent / push);
    check->rules[DEPTH].claimed = check->claims[3];
    check->rules[DEPTH].found = check->deepest;
    for (int i = 0; i < CLAIMS; i++) compare(check, CLAIM, check->claims[i], found[i]);
}

int verify_bytes(const unsigned char *file, size_t size, const unsigned char *motion, size_t motion_size, Rule *rules,
                 const char **wrong) {
    Check check = {.rules = rules};
    memcpy(rules, RULE_TABLE, sizeof RULE_TABLE);
    *wrong = open_file(&check.file, file, size);
    if (*wrong != NULL) return BROKEN;
    excess(&check, FINITE, 0);
    check_header(&check);
    check_plates(&check);
    if (motion != NULL) check_motion_file(&check, motion, motion_size);
    check_steps(&check);
    check_totals(&check);
    for (int i = 0; i < RULES; i++)
        if (!(rules[i].difference <= rules[i].tolerance)) return REJECTED;
    return ACCEPTED;
}
