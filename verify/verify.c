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
static Vec plus(Vec a, Vec b) { return (Vec){a.x + b.x, a.y + b.y, a.z + b.z}; }
static Vec minus(Vec a, Vec b) { return (Vec){a.x - b.x, a.y - b.y, a.z - b.z}; }
static Vec times(Vec a, double s) { return (Vec){a.x * s, a.y * s, a.z * s}; }
static Vec entrywise(Vec a, Vec b) { return (Vec){a.x * b.x, a.y * b.y, a.z * b.z}; }
static Vec cross(Vec a, Vec b) { return (Vec){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
static double dot(Vec a, Vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static double length(Vec a) { return sqrt(dot(a, a)); }
static Vec mirrored(Vec a) { return (Vec){-a.x, a.y, a.z}; }
static const Vec NONE = {0, 0, 0};
typedef struct { double w; Vec v; } Quaternion;
static double norm(Quaternion q) { return sqrt(q.w * q.w + dot(q.v, q.v)); }
static Quaternion inverse(Quaternion q) { return (Quaternion){q.w, times(q.v, -1)}; }
static Quaternion product(Quaternion a, Quaternion b) {
    return (Quaternion){a.w * b.w - dot(a.v, b.v), plus(plus(times(b.v, a.w), times(a.v, b.w)), cross(a.v, b.v))};
}
static Vec rotated(Quaternion q, Vec a) {
    Vec t = times(cross(q.v, a), 2);
    return plus(plus(a, times(t, q.w)), cross(q.v, t));
}
static Quaternion normalised(Quaternion q) { return (Quaternion){q.w / norm(q), times(q.v, 1 / norm(q))}; }
/* exp, of a rotation vector. */
static Quaternion rotation_by(Vec turn) {
    double angle = fmax(length(turn), 1e-300); /* not 0 */
    return (Quaternion){cos(angle / 2), times(turn, sin(angle / 2) / angle)};
}
/* log, the vector of the shorter rotation. */
static Vec turn_of(Quaternion q) {
    double sine = fmax(length(q.v), 1e-300), angle = 2 * atan2(sine, fabs(q.w));
    return times(q.v, (q.w < 0 ? -angle : angle) / sine);
}
/* The angle between two rotations. */
static double angle_between(Quaternion a, Quaternion b) { return length(turn_of(product(inverse(a), b))); }

/* ---- Bytes: integers of the file are little-endian, whatever the machine is ---- */
static uint64_t integer_at(const Byte *at, int bytes) {
    uint64_t value = 0;
    for (int i = 0; i < bytes; i++) value |= (uint64_t)at[i] << (8 * i);
    return value;
}
static double number_at(const Byte *at) {
    union { uint64_t bits; double value; } number = {integer_at(at, 8)};
    return number.value;
}
static Vec vector_at(const Byte *at) { return (Vec){number_at(at), number_at(at + 8), number_at(at + 16)}; }

/* SHA-256, FIPS 180-4: the constants of section 4.2.2. Its words are big-endian. */
static const uint32_t ROOTS[64] = {
    0x428a2f98, 0x71374491, 0xb5c0fbcf, 0xe9b5dba5, 0x3956c25b, 0x59f111f1, 0x923f82a4, 0xab1c5ed5,
    0xd807aa98, 0x12835b01, 0x243185be, 0x550c7dc3, 0x72be5d74, 0x80deb1fe, 0x9bdc06a7, 0xc19bf174,
    0xe49b69c1, 0xefbe4786, 0x0fc19dc6, 0x240ca1cc, 0x2de92c6f, 0x4a7484aa, 0x5cb0a9dc, 0x76f988da,
    0x983e5152, 0xa831c66d, 0xb00327c8, 0xbf597fc7, 0xc6e00bf3, 0xd5a79147, 0x06ca6351, 0x14292967,
    0x27b70a85, 0x2e1b2138, 0x4d2c6dfc, 0x53380d13, 0x650a7354, 0x766a0abb, 0x81c2c92e, 0x92722c85,
    0xa2bfe8a1, 0xa81a664b, 0xc24b8b70, 0xc76c51a3, 0xd192e819, 0xd6990624, 0xf40e3585, 0x106aa070,
    0x19a4c116, 0x1e376c08, 0x2748774c, 0x34b0bcb5, 0x391c0cb3, 0x4ed8aa4a, 0x5b9cca4f, 0x682e6ff3,
    0x748f82ee, 0x78a5636f, 0x84c87814, 0x8cc70208, 0x90befffa, 0xa4506ceb, 0xbef9a3f7, 0xc67178f2};
static uint32_t word_at(const Byte *at) { return (uint32_t)at[0] << 24 | (uint32_t)(at[1] << 16 | at[2] << 8 | at[3]); }
static uint32_t rotr(uint32_t a, int bits) { return a >> bits | a << (32 - bits); }
static uint32_t sigma(uint32_t a, int one, int two, int shift) { return rotr(a, one) ^ rotr(a, two) ^ a >> shift; }
/* Section 6.2.2: one block changes the hash. */
static void hash_block(uint32_t *hash, const Byte *block) {
    uint32_t w[64];
    for (int i = 0; i < 16; i++) w[i] = word_at(block + 4 * i);
    for (int i = 16; i < 64; i++)
        w[i] = sigma(w[i - 2], 17, 19, 10) + w[i - 7] + sigma(w[i - 15], 7, 18, 3) + w[i - 16];
    uint32_t a = hash[0], b = hash[1], c = hash[2], d = hash[3], e = hash[4], f = hash[5], g = hash[6], h = hash[7];
    for (int i = 0; i < 64; i++) {
        uint32_t first = h + (rotr(e, 6) ^ rotr(e, 11) ^ rotr(e, 25)) + ((e & f) ^ (~e & g)) + ROOTS[i] + w[i];
        uint32_t second = (rotr(a, 2) ^ rotr(a, 13) ^ rotr(a, 22)) + ((a & b) ^ (a & c) ^ (b & c));
        h = g; g = f; f = e; e = d + first; d = c; c = b; b = a; a = first + second;
    }
    hash[0] += a; hash[1] += b; hash[2] += c; hash[3] += d; hash[4] += e; hash[5] += f; hash[6] += g; hash[7] += h;
}
/* Says whether the bytes have the expected SHA-256. */
static int hash_is(const Byte *bytes, size_t size, const Byte *expected) {
    uint32_t hash[8] = {0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a, 0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
    Byte tail[128] = {0};
    size_t rest = size % 64, tail_size = rest < 56 ? 64 : 128;
    memcpy(tail, bytes + size - rest, rest); tail[rest] = 0x80;
    for (size_t i = 0; i < 8; i++) tail[tail_size - 1 - i] = (Byte)((uint64_t)size * 8 >> (8 * i));
    for (size_t i = 0; i < size / 64; i++) hash_block(hash, bytes + 64 * i);
    for (size_t i = 0; i < tail_size; i += 64) hash_block(hash, tail + i);
    for (int i = 0; i < 8; i++) if (hash[i] != word_at(expected + 4 * i)) return 0;
    return 1;
}

/* ---- The numbers of a file: section "Format". These structures are doubles in the order of its tables. ---- */
typedef struct { Vec from, to; double radius; } Capsule;
typedef struct { Vec offset, centre; double mass, along, across, kp, kd, armature, bound; Capsule capsule; } Body;
typedef struct { double body; Vec centre; double radius; } Point;
typedef struct { double constants[11], beta[SHAPES], claims[4]; Body bodies[BODIES]; Point points[POINTS]; } Header;
typedef struct { double x, y, yaw, half_first, half_second, height, k, c; } Plate;
typedef struct { Vec place; Quaternion turn[BODIES]; Vec speed, spin[BODIES]; } State;
typedef struct {
    State now; Vec speed_after, spin_after[BODIES];
    Quaternion target[JOINTS]; Vec target_spin[JOINTS], torque[JOINTS], force[POINTS]; /* of joints: from joint 1 on */
} Step;
enum { NUMBERS_START = 64, PLATES_START = NUMBERS_START + sizeof(Header), HASH_SIZE = 32 };
/* A member of the motion file: its numbers, row by row. NO_ARRAY: it has another form, or is there twice. */
typedef struct { const Byte *numbers; double rows, columns; } Array;
static const Array NO_ARRAY = {NULL, NAN, NAN};
/* What the rules share: the file, the step that is looked at, the body, the floor and the plates, and sums. */
typedef struct {
    const Byte *file, *steps;
    long step_count, frame_steps, plate_count, step;
    Rule *rules;
    Header header; Plate grounds[1 + MOST_PLATES]; Array poses, places;
    double speed_sum, spin_sum, push, beyond, pull, absent, deepest, effort;
} Check;

/* "A broken file": says what is wrong, or NULL. */
static const char *open_file(Check *check, const Byte *bytes, size_t size) {
    if (size < PLATES_START || memcmp(bytes, "MIMICERT\6\0\0\0", 12) != 0) return "not a certificate of version 6";
    uint64_t frame_steps = integer_at(bytes + 12, 4), steps = integer_at(bytes + 16, 8);
    uint64_t plates = integer_at(bytes + 24, 8), start = PLATES_START + plates * sizeof(Plate);
    if (steps < 1 || steps > 1 << 24 || plates > MOST_PLATES) return "no or too many steps, or too many plates";
    if (frame_steps < 1 || frame_steps > 240 || steps % frame_steps != 0) return "frames do not divide the steps";
    if (size != start + steps * sizeof(Step) + sizeof(State) + HASH_SIZE) return "size differs from that of its steps";
    if (!hash_is(bytes, size - HASH_SIZE, bytes + size - HASH_SIZE)) return "hash differs";
    check->file = bytes; check->steps = bytes + start; check->plate_count = (long)plates;
    check->step_count = (long)steps; check->frame_steps = (long)frame_steps;
    return NULL;
}
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
/* Reads bytes into a structure of doubles. Rule 5: a number that fails counts as 0. */
static void read_numbers(Check *check, const Byte *from, size_t size, void *to) {
    for (size_t i = 0; i < size; i += 8) {
        double number = number_at(from + i), kept = fabs(number) < 1e9 ? number : 0;
        excess(check, FINITE, kept != number);
        memcpy((Byte *)to + i, &kept, sizeof kept);
    }
}

/* ---- The body: section "Body" ---- */
typedef struct { double size, girth, foot, hand, head; } Scales;
/* "Scales". */
static Scales scales_of(const double *beta) {
    double size = 1 + .03 * beta[0];
    return (Scales){size, size + .06 * beta[1], size + .04 * beta[7], size + .03 * beta[4], size + .04 * beta[8]};
}
/* "Offsets" and "Capsules". The right side is the mirror image of the left. */
static void set_skeleton(Body *bodies, const double *beta) {
    Scales s = scales_of(beta);
    const Vec size = {s.size, s.size, s.size}, gains[] = {
        [TORSO] = {0, .03 * beta[3] - .02 * beta[9], 0}, [SHOULDER] = {.05 * beta[5], .02 * beta[3], 0},
        [LEG] = {0, .03 * beta[2] + .02 * beta[9], 0}, [HEAD] = {.04 * beta[8], .04 * beta[8], .04 * beta[8]},
        [HIP] = {.04 * beta[6], 0, 0}, [FOOT] = {0, 0, .04 * beta[7]}, [ARM] = {.03 * beta[4], 0, 0}};
    for (int i = 0; i < BODIES; i++) bodies[i].offset = entrywise(ROWS[i].offset, plus(size, gains[ROWS[i].part]));
    for (int i = 0; i < COUNT(CAPSULES); i++) {
        Vec unit = CAPSULES[i].child > 0 ? bodies[CAPSULES[i].child].offset : size;
        Vec from = entrywise(CAPSULES[i].from, unit), to = entrywise(CAPSULES[i].to, unit);
        bodies[CAPSULES[i].body].capsule = (Capsule){from, to, CAPSULES[i].radius * s.girth};
    }
    Capsule *thigh = &bodies[1].capsule;
    thigh->radius = fmin(thigh->radius, fabs(bodies[1].offset.x + thigh->from.x) - .001);
    Vec ball = bodies[10].offset;
    double y = .034 * s.size - (.022 - ball.y), toe = .020 * s.size - .022;
    bodies[7].capsule = (Capsule){{0, y, -.022 * s.foot}, {ball.x, y, ball.z - .014 * s.foot}, .034 * s.size};
    bodies[10].capsule = (Capsule){{0, toe, .012 * s.foot}, {0, toe, .052 * s.foot}, .020 * s.size};
    bodies[15].capsule = (Capsule){{0, .03 * s.head, 0}, {0, .105 * s.head, 0}, .085 * s.head};
    bodies[20].capsule = (Capsule){{.03 * s.hand, -.004, 0}, {.14 * s.hand, -.010, .004}, .030 * s.hand};
    for (int i = 0; i < BODIES; i++) {
        Capsule left = bodies[LEFT_OF[i]].capsule;
        if (LEFT_OF[i] == i) continue;
        bodies[i].offset = mirrored(bodies[LEFT_OF[i]].offset);
        bodies[i].capsule = (Capsule){mirrored(left.from), mirrored(left.to), left.radius};
    }
}
/* The axis of a capsule, a place on it at a share of its length, and its volume but for the factor pi. */
static Vec axis_of(Capsule c) { return minus(c.to, c.from); }
static Vec on_axis(Capsule c, double share) { return plus(c.from, times(axis_of(c), share)); }
static double volume(Capsule c) { return c.radius * c.radius * (length(axis_of(c)) + 4 * c.radius / 3); }
/* The bodies of a shape: "Mass", "Centre of mass", "Inertia" and "Joints". */
static void build_bodies(Body *bodies, const double *beta) {
    Body mean[BODIES]; double whole = 0;
    set_skeleton(mean, (const double[SHAPES]){0});
    set_skeleton(bodies, beta);
    for (int i = 0; i < BODIES; i++) {
        Body *body = &bodies[i];
        double h = length(axis_of(body->capsule)), r = body->capsule.radius;
        body->mass = 70 * ROWS[LEFT_OF[i]].share * volume(body->capsule) / volume(mean[i].capsule);
        double cylinder = body->mass * h / (h + 4 * r / 3), balls = body->mass - cylinder;
        body->along = (cylinder / 2 + 2 * balls / 5) * r * r;
        body->across = cylinder * (h * h / 12 + r * r / 4) + balls * (2 * r * r / 5 + h * h / 4 + 3 * h * r / 8);
        body->centre = on_axis(body->capsule, .5);
        whole += body->mass;
    }
    for (int i = 0; i < BODIES; i++) {
        const Row *row = &ROWS[LEFT_OF[i]];
        bodies[i].kd = (bodies[i].kp = row->kp * whole / 70) / 10;
        bodies[i].armature = row->armature;
        bodies[i].bound = row->bound * whole / 70;
        if (row->part == TORSO) bodies[i].centre.z = row->centre * scales_of(beta).size;
        if (row->along == 0) continue;
        Vec bone = bodies[i].offset, back = {0, -bone.z, bone.y};
        Body *limb = &bodies[PARENT[i]];
        limb->centre = plus(times(bone, row->centre), times(back, row->behind * length(bone) / length(back)));
        limb->across = limb->mass * dot(bone, bone) * pow(row->across, 2);
        limb->along = limb->mass * dot(bone, bone) * pow(row->along, 2);
    }
}
/* "Contact points": of the left foot, its instep and the pelvis, their mirror images, and spheres on the axes. */
static void build_points(Point *points, const Body *bodies, Scales s) {
    Vec ball = bodies[10].offset, half = {.040 * s.size, 0, 0};
    double heel = .026 * s.size, toe = .030 * s.size, sole = ball.y - .022;
    const Point one[] = {
        {7, {-heel, sole, -.052 * s.foot}, 0}, {7, {heel, sole, -.052 * s.foot}, 0},
        {7, minus(ball, half), .022}, {7, plus(ball, half), .022},
        {10, {-toe, -.022, .068 * s.foot}, 0}, {10, {toe, -.022, .062 * s.foot}, 0},
        {7, {ball.x, sole + .036 * s.size, .6 * ball.z}, .026 * s.size},
        {0, times((Vec){-.062, -.085, -.043}, s.size), .105 * s.girth - .025 * s.size}};
    for (int i = 0; i < COUNT(one); i++) {
        points[i < 6 ? i : 2 * i] = one[i];
        points[i < 6 ? i + 6 : 2 * i + 1] = (Point){one[i].body + (i < 7), mirrored(one[i].centre), one[i].radius};
    }
    for (int i = 0; i < COUNT(SPHERES); i++) {
        Capsule capsule = bodies[SPHERES[i].body].capsule;
        points[16 + i] = (Point){SPHERES[i].body, on_axis(capsule, SPHERES[i].share), capsule.radius};
    }
}
/* Rules 3, 4 and 27. The laws below use the body that is built here, not the recorded one. The floor has no sides. */
static void check_header(Check *check) {
    double stated[] = {RATE, GRAVITY, FLOOR_K, FLOOR_C, FRICTION, SLIP_SPEED, SKIN, SELF_K, SELF_C, RANGE_K, RANGE_C};
    Header *header = &check->header;
    double found[sizeof *header / 8];
    read_numbers(check, check->file + NUMBERS_START, sizeof *header, header);
    memcpy(header->constants, stated, sizeof stated);
    build_bodies(header->bodies, header->beta);
    build_points(header->points, header->bodies, scales_of(header->beta));
    memcpy(found, header, sizeof found);
    for (int i = 0; i < COUNT(found); i++)
        compare(check, i < COUNT(stated) ? CONSTANT : SHAPE, number_at(check->file + NUMBERS_START + 8 * i), found[i]);
    for (int i = 0; i < SHAPES; i++) excess(check, SHAPE, positive(fabs(header->beta[i]) - 5));
    check->grounds[0] = (Plate){.k = FLOOR_K, .c = FLOOR_C};
    read_numbers(check, check->file + PLATES_START, sizeof(Plate) * (size_t)check->plate_count, &check->grounds[1]);
    note(check, SCENE, (double)check->plate_count, (double)check->plate_count, 0);
    for (long i = 0; i < 8 * check->plate_count; i++) {
        double number = number_at(check->file + PLATES_START + 8 * i);
        if (number < PLATE_RANGE[i % 8][0] || number > PLATE_RANGE[i % 8][1]) excess(check, SCENE, INFINITY);
    }
}

/* ---- The motion file: section "The motion file" ---- */
/* Reads a member as an array of NumPy, of doubles (f8) or of texts of six letters (U6). A size that is missing is 1. */
static Array read_array(const Byte *member, uint64_t size, const char *type) {
    static const char START[] = "\x93NUMPY\1\0v\0{'descr': '<", NEXT[] = "', 'fortran_order': False, 'shape': (";
    if (size < 128 || memcmp(member, START, 22) != 0 || memcmp(member + 22, type, 2) != 0) return NO_ARRAY;
    if (memcmp(member + 24, NEXT, sizeof NEXT - 1) != 0 || member[127] != '\n') return NO_ARRAY;
    const Byte *at = member + 24 + sizeof NEXT - 1;
    double sizes[2] = {1, 1};
    for (int i = 0; i < 2 && *at != ')'; i++) {
        for (sizes[i] = 0; *at >= '0' && *at <= '9'; at++) sizes[i] = 10 * sizes[i] + (*at - '0');
        if (*at == ',') at += at[1] == ' ' ? 2 : 1;
    }
    int holds = strncmp((const char *)at, "), }", 4) == 0 &&
                (*type == 'U' ? 24 : 8) * sizes[0] * sizes[1] == (double)(size - 128);
    return holds ? (Array){member + 128, sizes[0], sizes[1]} : NO_ARRAY;
}
/* Finds NAME.npy, for which NumPy also takes NAME, from the front of a zip. */
static Array find_array(const Byte *zip, size_t size, const char *name, const char *type) {
    Array found = {NULL, 0, 0};
    size_t length = strlen(name), copies = 0;
    for (uint64_t at = 0, end; size - at >= 30 && memcmp(zip + at, "PK\3\4", 4) == 0; at = end) {
        uint64_t name_size = integer_at(zip + at + 26, 2), start = at + 30 + name_size + integer_at(zip + at + 28, 2);
        end = start + integer_at(zip + at + 22, 4);
        if ((integer_at(zip + at + 6, 2) & 8) != 0 || integer_at(zip + at + 8, 2) != 0 || end > size) break;
        if ((name_size == length || name_size == length - 4) && memcmp(zip + at + 30, name, (size_t)name_size) == 0)
            found = copies++ == 0 ? read_array(zip + start, end - start, type) : NO_ARRAY;
    }
    return found;
}
/* The body is ours, and no member is there from which programs take other poses, places or bones. */
static int is_plain(const Byte *zip, size_t size) {
    static const char *const OTHERS[] = {"root_orient.npy", "global_orient.npy", "pose_body.npy", "body_pose.npy",
                                         "smpl_scaling.npy", "rest_joints.npy"};
    Array model = find_array(zip, size, "body_model.npy", "U6");
    for (int i = 0; i < COUNT(OTHERS); i++) if (find_array(zip, size, OTHERS[i], "f8").rows != 0) return 0;
    return model.rows == 1 && memcmp(model.numbers, "m\0\0\0i\0\0\0m\0\0\0i\0\0\0c\0\0\0x\0\0", 24) == 0;
}
/* Rules 1, 2 and 27. The frames are compared when their states are read. The flat floor has no member of plates. */
static void check_motion_file(Check *check, const Byte *zip, size_t size) {
    Array poses = find_array(zip, size, "poses.npy", "f8"), places = find_array(zip, size, "trans.npy", "f8");
    Array beta = find_array(zip, size, "betas.npy", "f8"), rate = find_array(zip, size, "mocap_framerate.npy", "f8");
    Array plates = find_array(zip, size, "scene_plates.npy", "f8");
    double frames = (double)(check->step_count / check->frame_steps + 1), m = (double)check->plate_count;
    int known = poses.rows == frames && poses.columns >= 66 && places.rows == frames && places.columns == 3 &&
                beta.rows * beta.columns >= SHAPES && rate.rows * rate.columns == 1 && is_plain(zip, size);
    int same = plates.rows == m && (m == 0 || plates.columns == 8);
    if (m > 0 && same) same = memcmp(plates.numbers, check->file + PLATES_START, sizeof(Plate) * (size_t)m) == 0;
    excess(check, MOTION_FILE, !hash_is(zip, size, check->file + 32));
    note(check, SCENE, m, plates.rows, same ? 0 : INFINITY);
    excess(check, FRAMES, known ? 0 : INFINITY);
    if (!known) return;
    compare(check, FRAMES, number_at(rate.numbers), RATE / (double)check->frame_steps);
    for (int i = 0; i < SHAPES; i++) compare(check, FRAMES, number_at(beta.numbers + 8 * i), check->header.beta[i]);
    check->poses = poses; check->places = places;
}

/* ---- States and steps ---- */
/* Reads a step, or at the end the last state, and normalises its quaternions. Rules 6 and 7, and 2 if it is a frame. */
static void read_step(Check *check, long index, Step *step) {
    State *state = &step->now;
    size_t size = index < check->step_count ? sizeof(Step) : sizeof(State);
    check->step = index;
    read_numbers(check, check->steps + sizeof(Step) * (size_t)index, size, step);
    for (int i = 0; i < BODIES; i++) {
        Vec hinge = ROWS[LEFT_OF[i]].hinge;
        compare(check, UNIT, norm(state->turn[i]), 1);
        state->turn[i] = normalised(state->turn[i]);
        excess(check, AXIS, 2 * length(cross(hinge, state->turn[i].v)));
        excess(check, AXIS, length(cross(hinge, state->spin[i])));
    }
    if (check->poses.numbers == NULL || index % check->frame_steps != 0) return;
    size_t frame = (size_t)(index / check->frame_steps), columns = (size_t)check->poses.columns;
    const Byte *place = check->places.numbers + 24 * frame, *pose = check->poses.numbers + 8 * columns * frame;
    excess(check, FRAMES, length(minus(plus(vector_at(place), (Vec){.003, -.351, .012}), state->place)));
    for (int i = 0; i < BODIES; i++)
        excess(check, FRAMES, angle_between(rotation_by(vector_at(pose + 24 * i)), state->turn[i]));
}
/* Rules 8 to 11, and the sums of 12 and 13: "Integration". */
static void check_integration(Check *check, const Step *step, const State *next) {
    double speed_error = length(minus(next->speed, step->speed_after));
    excess(check, POSITION, length(minus(next->place, plus(step->now.place, times(next->speed, 1 / RATE)))));
    excess(check, VELOCITY, speed_error); check->speed_sum += speed_error;
    for (int i = 0; i < BODIES; i++) {
        Quaternion turn = product(step->now.turn[i], rotation_by(times(next->spin[i], 1 / RATE)));
        double spin_error = length(minus(next->spin[i], step->spin_after[i]));
        excess(check, ROTATION, angle_between(turn, next->turn[i]));
        excess(check, SPIN, spin_error); check->spin_sum += spin_error;
    }
}

/* ---- The laws of mechanics: section "The laws" ---- */
/* How a body turns, how its joint or another point of it moves, what the joint carries, and the body's capsule. */
typedef struct {
    Quaternion turn; Vec place, speed, acceleration, spin, spin_rate, force, moment; Capsule capsule;
} Motion;
/* Where a place in a body's axes is, and how the point of the body moves that is at a place of the world. */
static Vec in_world(const Motion *body, Vec place) { return plus(body->place, rotated(body->turn, place)); }
static Motion point_at(const Motion *body, Vec place) {
    Motion point = *body;
    Vec arm = minus(place, body->place), swing = cross(body->spin, arm);
    point.place = place;
    point.speed = plus(body->speed, swing);
    point.acceleration = plus(body->acceleration, plus(cross(body->spin_rate, arm), cross(body->spin, swing)));
    return point;
}
/* The joint of a body carries one more force, which is needed at a place, and one more moment. */
static void carry(Motion *body, Vec place, Vec force, Vec moment) {
    body->force = plus(body->force, force);
    body->moment = plus(body->moment, plus(moment, cross(minus(place, body->place), force)));
}
/* How fast the angular velocity of a body changes in a step, in its axes. */
static Vec spin_rate(const Step *step, int i) { return times(minus(step->spin_after[i], step->now.spin[i]), RATE); }
/* "Motion of the bodies", from the pelvis outwards. A body starts from its parent's motion, and carries nothing. */
static void find_motions(const Check *check, const Step *step, Motion *motions) {
    motions[0] = (Motion){.turn = {1, NONE}, .place = step->now.place, .speed = step->now.speed};
    motions[0].acceleration = times(minus(step->speed_after, step->now.speed), RATE);
    for (int i = 0; i < BODIES; i++) {
        const Capsule *capsule = &check->header.bodies[i].capsule;
        Motion *body = &motions[i], *parent = &motions[PARENT[i]];
        *body = point_at(parent, in_world(parent, check->header.bodies[i].offset));
        body->turn = product(body->turn, step->now.turn[i]);
        Vec spin = rotated(body->turn, step->now.spin[i]), rate = rotated(body->turn, spin_rate(step, i));
        body->spin_rate = plus(body->spin_rate, plus(rate, cross(body->spin, spin)));
        body->spin = plus(body->spin, spin);
        body->capsule = (Capsule){in_world(body, capsule->from), in_world(body, capsule->to), capsule->radius};
    }
}

/* "Ground": the plate that counts under a place, or the floor, which is lower than all plates. */
static const Plate *ground_under(const Check *check, Vec place) {
    const Plate *ground = check->grounds;
    for (const Plate *plate = ground + 1; plate <= check->grounds + check->plate_count; plate++) {
        double x = place.x - plate->x, y = place.y - plate->y, z = place.z - plate->height;
        if (plate->height <= ground->height || z <= -PLATE_REACH || z >= SKIN + FIRST_TOUCH) continue;
        double first = cos(plate->yaw) * x + sin(plate->yaw) * y, second = cos(plate->yaw) * y - sin(plate->yaw) * x;
        if (fabs(first) <= plate->half_first && fabs(second) <= plate->half_second) ground = plate;
    }
    return ground;
}
/* "Ground", rules 19 to 25: checks the force on each point. The joints need not carry it. */
static void check_ground(Check *check, const Step *step, Motion *motions) {
    for (int i = 0; i < POINTS; i++) {
        const Point *point = &check->header.points[i];
        Motion *body = &motions[(int)point->body];
        Motion touch = point_at(body, minus(in_world(body, point->centre), (Vec){0, 0, point->radius}));
        const Plate *ground = ground_under(check, touch.place);
        double depth = ground->height - touch.place.z, overlap = depth + SKIN;
        check->deepest = fmax(check->deepest, depth);
        if (ground == check->grounds) excess(check, DEPTH, positive(depth));
        else overlap = fmin(overlap, PLATE_PUSH / ground->k);
        Vec after = plus(touch.speed, times(touch.acceleration, 1 / RATE)), force = step->force[i];
        Vec friction = {force.x, force.y, 0}, slip = {after.x, after.y, 0};
        double law = ground->k * positive(overlap) - (ground->c + ground->k / RATE) * after.z;
        int touches = overlap > -FIRST_TOUCH, has_force = length(force) > 0;
        carry(body, touch.place, times(force, -1), NONE);
        if (!touches) excess(check, AIR, length(force));
        if (overlap > 0 && !has_force) check->absent += positive(law);
        if (!touches || !has_force) continue;
        compare(check, NORMAL, force.z, law);
        excess(check, SIDEWAYS, length(plus(friction, times(slip, length(friction) / fmax(length(slip), 1e-200)))));
        check->push += positive(force.z); check->pull += positive(-force.z);
        check->beyond += positive(length(friction) - FRICTION * positive(force.z));
    }
}
/* "Closest points", of the axes of two capsules. */
static void find_closest(Capsule one, Capsule two, Vec *c1, Vec *c2) {
    Vec u = axis_of(one), w = axis_of(two), d = minus(one.from, two.from);
    double a = fmax(dot(u, u), 1e-9), e = fmax(dot(w, w), 1e-9), b = dot(u, w), c = dot(u, d), f = dot(w, d);
    double s = limited((b * f - c * e) / fmax(a * e - b * b, 1e-9)), t = (b * s + f) / e;
    if (!(t >= 0 && t <= 1)) s = limited((b * limited(t) - c) / a);
    *c1 = on_axis(one, s); *c2 = on_axis(two, limited(t));
}
/* "Self contact" of two bodies. The joints need not carry its forces. */
static void add_self_contact(Motion *one, Motion *two) {
    double one_radius = one->capsule.radius, two_radius = two->capsule.radius;
    Vec c1, c2; find_closest(one->capsule, two->capsule, &c1, &c2);
    double distance = fmax(length(minus(c1, c2)), 1e-6), overlap = one_radius + two_radius - distance;
    if (overlap <= 0) return;
    Vec normal = times(minus(c1, c2), 1 / distance), place = plus(c2, times(normal, two_radius - overlap / 2));
    Vec slip = minus(point_at(one, place).speed, point_at(two, place).speed);
    double push = positive(SELF_K * overlap - SELF_C * dot(slip, normal));
    carry(one, place, times(normal, -push), NONE);
    carry(two, place, times(normal, push), NONE);
}
/* "Newton, Euler": the joint carries what a body needs for its motion, in spite of gravity. The inertia times a is
 * across a + (along - across) (u . a) u, with u of length 1 along the capsule's axis. */
static void add_inertia(const Body *body, Motion *motion) {
    Motion centre = point_at(motion, in_world(motion, body->centre));
    Vec u = times(axis_of(motion->capsule), 1 / length(axis_of(motion->capsule)));
    Vec along = plus(times(u, dot(u, motion->spin_rate)), times(cross(motion->spin, u), dot(u, motion->spin)));
    Vec moment = plus(times(motion->spin_rate, body->across), times(along, body->along - body->across));
    carry(motion, centre.place, times(plus(centre.acceleration, (Vec){0, 0, GRAVITY}), body->mass), moment);
}
/* "Range": the torque on a joint that is beyond its range. On the right side it is the mirror image. */
static Vec range_torque(int i, Quaternion turn, Vec spin_after) {
    const Row *row = &ROWS[LEFT_OF[i]];
    double side = LEFT_OF[i] == i ? 1 : -1;
    Vec half = times(row->range_half, PI / 360), scale = {.5 / sin(half.x), .5 / sin(half.y), .5 / sin(half.z)};
    Vec centre = times(entrywise(row->range_centre, (Vec){1, side, side}), PI / 180);
    Quaternion q = product(inverse(rotation_by(centre)), turn);
    Vec s = entrywise(times(q.v, q.w < 0 ? -2 : 2), scale), d = entrywise(s, scale);
    double g = length(s); if (g <= 1) return NONE;
    Vec spring = times(d, RANGE_K * (g - 1) * g / dot(d, d));
    return times(plus(spring, times(spin_after, RANGE_C + RANGE_K / RATE)), -1);
}
/* Rules 17 and 18: "Controller", whose law is kp phi + kd omega* - (kd + dt kp) omega', as omega' = omega + dt rate. */
static void check_controller(Check *check, const Step *step, int i) {
    const Body *body = &check->header.bodies[i];
    Vec phi = turn_of(product(inverse(step->now.turn[i]), normalised(step->target[i - 1])));
    Vec spring = plus(times(phi, body->kp), times(step->target_spin[i - 1], body->kd));
    Vec law = minus(spring, times(step->spin_after[i], body->kd + body->kp / RATE));
    double effort = length(step->torque[i - 1]) / body->bound;
    excess(check, BOUND, positive(effort - 1));
    if (!(fabs(effort - 1) <= 1e-9)) excess(check, LAW, length(minus(step->torque[i - 1], law)));
    check->effort = fmax(check->effort, effort);
}
/* Rules 14 to 18, from the outer bodies inwards. The pelvis has no joint: nothing may be left there. */
static void check_mechanics(Check *check, const Step *step, Motion *motions) {
    for (int i = BODIES - 1; i > 0; i--) {
        Motion *motion = &motions[i];
        Vec hinge = ROWS[LEFT_OF[i]].hinge;
        add_inertia(&check->header.bodies[i], motion);
        check_controller(check, step, i);
        Vec torque = plus(step->torque[i - 1], range_torque(i, step->now.turn[i], step->spin_after[i]));
        Vec law = minus(torque, times(spin_rate(step, i), check->header.bodies[i].armature));
        Vec difference = minus(rotated(inverse(motion->turn), motion->moment), law);
        excess(check, JOINT, length(hinge) == 0 ? length(difference) : fabs(dot(difference, hinge)));
        carry(&motions[PARENT[i]], motion->place, motion->force, motion->moment);
    }
    add_inertia(&check->header.bodies[0], &motions[0]);
    excess(check, FORCE, length(motions[0].force));
    excess(check, MOMENT, length(motions[0].moment));
}

/* Rules 8 to 26: of all steps, then of their sums. */
static void check_steps(Check *check) {
    Step next; Motion motions[BODIES];
    read_step(check, 0, &next);
    for (long i = 0; i < check->step_count; i++) {
        Step step = next;
        read_step(check, i + 1, &next);
        check->step = i;
        check_integration(check, &step, &next.now);
        find_motions(check, &step, motions);
        check_ground(check, &step, motions);
        for (int k = 0; k < COUNT(PAIRS); k++)
            for (int n = 0; n < PAIRS[k].count; n++)
                add_self_contact(&motions[PAIRS[k].first], &motions[PAIRS[k].second[n]]);
        check_mechanics(check, &step, motions);
    }
    double steps = (double)check->step_count, push = check->push < 1 ? 1 : check->push;
    const double *claims = check->header.claims;
    const double found[] = {check->effort, check->beyond / push, check->pull / push, check->deepest};
    check->step = 0;
    excess(check, MEAN_VELOCITY, check->speed_sum / steps);
    excess(check, MEAN_SPIN, check->spin_sum / steps / BODIES);
    note(check, CONE, claims[1], found[1], found[1]);
    note(check, PULL, claims[2], found[2], found[2]);
    excess(check, ABSENT, check->absent / push);
    for (int i = 0; i < COUNT(found); i++) compare(check, CLAIM, claims[i], found[i]);
}
int verify_bytes(const Byte *file, size_t size, const Byte *zip, size_t zip_size, Rule *rules, const char **wrong) {
    Check check = {.rules = rules};
    for (int i = 0; i < RULES; i++)
        rules[i] = (Rule){RULE_TABLE[i].name, RULE_TABLE[i].unit, RULE_TABLE[i].tolerance, 0, 0, 0, -1};
    if ((*wrong = open_file(&check, file, size)) != NULL) return BROKEN;
    check_header(&check);
    if (zip != NULL) check_motion_file(&check, zip, zip_size);
    check_steps(&check);
    for (int i = 0; i < RULES; i++)
        if (rules[i].difference > rules[i].tolerance) return REJECTED;
    return ACCEPTED;
}
