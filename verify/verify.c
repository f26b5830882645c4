/* Checks certificates of motion. Format and rules: docs/certificate.md, from which alone it is written.
 * C99, libc and libm, no memory of its own but static arrays. Vectors are double[3], rotation matrices double[9] by rows.
 * Its dynamics: recursive Newton-Euler over the recorded states, axes of the world, moments about the joints. */
#include <math.h>
#include <stdint.h>
#include <string.h>

#include "verify.h"
#include "tables.h"

enum { STATE = 160, RECORD = 550, FIXED = 80, NUMBERS = CONSTANTS + BETAS + CLAIMS + BODIES * PER_BODY + POINTS * 5 };


/* ---- SHA-256 (FIPS 180-4) ---- */

#define ROTATE(x, k) (((x) >> (k)) | ((x) << (32 - (k))))
static void sha_block(uint32_t h[8], const unsigned char *p) {
  uint32_t w[64], s[8], a, b;
  int i;
  for (i = 0; i < 16; ++i, p += 4)
    w[i] = (uint32_t)p[0] << 24 | (uint32_t)p[1] << 16 | (uint32_t)p[2] << 8 | p[3];
  for (; i < 64; ++i)
    w[i] = w[i - 16] + w[i - 7] + (ROTATE(w[i - 15], 7) ^ ROTATE(w[i - 15], 18) ^ w[i - 15] >> 3) +
           (ROTATE(w[i - 2], 17) ^ ROTATE(w[i - 2], 19) ^ w[i - 2] >> 10);
  memcpy(s, h, sizeof s);
  for (i = 0; i < 64; ++i) {
    a = s[7] + (ROTATE(s[4], 6) ^ ROTATE(s[4], 11) ^ ROTATE(s[4], 25)) + ((s[4] & s[5]) ^ (~s[4] & s[6])) + K[i] + w[i];
    b = (ROTATE(s[0], 2) ^ ROTATE(s[0], 13) ^ ROTATE(s[0], 22)) + ((s[0] & s[1]) ^ (s[0] & s[2]) ^ (s[1] & s[2]));
    s[7] = s[6], s[6] = s[5], s[5] = s[4], s[4] = s[3] + a;
    s[3] = s[2], s[2] = s[1], s[1] = s[0], s[0] = a + b;
  }
  for (i = 0; i < 8; ++i) h[i] += s[i];
}
static void sha256(const unsigned char *p, size_t n, unsigned char out[32]) {
  uint32_t h[8] = {0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a, 0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
  unsigned char last[128] = {0};
  size_t left = n % 64, size = left < 56 ? 64 : 128, i;
  for (i = 0; i + 64 <= n; i += 64) sha_block(h, p + i);
  memcpy(last, p + i, left);
  last[left] = 0x80;
  for (i = 0; i < 8; ++i) last[size - 1 - i] = (unsigned char)((uint64_t)n * 8 >> 8 * i);
  for (i = 0; i < size; i += 64) sha_block(h, last + i);
  for (i = 0; i < 32; ++i) out[i] = (unsigned char)(h[i / 4] >> (24 - 8 * (i % 4)));
}

/* ---- reading ---- */
static uint64_t integer(const unsigned char *p, int bytes) {
  uint64_t v = 0;
  while (bytes--) v = v << 8 | p[bytes];
  return v;
}
static double number(const unsigned char *p) {
  uint64_t bits = integer(p, 8);
  double v;
  memcpy(&v, &bits, 8);
  return v;
}

/* ---- vectors, quaternions (w, x, y, z) ---- */
static double dot(const double *a, const double *b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
static double length(const double *a) { return sqrt(dot(a, a)); }
static void cross(double *o, const double *a, const double *b) {
  double x = a[1] * b[2] - a[2] * b[1], y = a[2] * b[0] - a[0] * b[2], z = a[0] * b[1] - a[1] * b[0];
  o[0] = x, o[1] = y, o[2] = z;
}
static void add(double *o, double s, const double *a) { o[0] += s * a[0], o[1] += s * a[1], o[2] += s * a[2]; }
static void add_cross(double *o, const double *a, const double *b) {
  double c[3];
  cross(c, a, b);
  add(o, 1, c);
}
static void copy(double *o, const double *a) { o[0] = a[0], o[1] = a[1], o[2] = a[2]; }
static void turn(double *o, const double *R, const double *a) {
  double x = dot(R, a), y = dot(R + 3, a), z = dot(R + 6, a);
  o[0] = x, o[1] = y, o[2] = z;
}
static void turn_back(double *o, const double *R, const double *a) {
  double x = R[0] * a[0] + R[3] * a[1] + R[6] * a[2], y = R[1] * a[0] + R[4] * a[1] + R[7] * a[2];
  o[2] = R[2] * a[0] + R[5] * a[1] + R[8] * a[2], o[0] = x, o[1] = y;
}
static void normalise(double *o, const double *q) {
  double n = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  int i;
  for (i = 0; i < 4; ++i) o[i] = q[i] / n;
}
/* o = a^-1 b with `sign` -1, o = a b with `sign` 1 */
static void product(double *o, double sign, const double *a, const double *b) {
  double u[3], c[3], w;
  u[0] = sign * a[1], u[1] = sign * a[2], u[2] = sign * a[3];
  cross(c, u, b + 1);
  w = a[0] * b[0] - dot(u, b + 1);
  o[1] = a[0] * b[1] + b[0] * u[0] + c[0], o[2] = a[0] * b[2] + b[0] * u[1] + c[1];
  o[3] = a[0] * b[3] + b[0] * u[2] + c[2], o[0] = w;
}
static void exponential(double *q, double s, const double *r) { /* the rotation by s r */
  double angle = fabs(s) * length(r), k = angle < 1e-6 ? 0.5 : sin(0.5 * angle) / angle;
  q[0] = cos(0.5 * angle), q[1] = k * s * r[0], q[2] = k * s * r[1], q[3] = k * s * r[2];
}
static void logarithm(double *r, const double *q) {
  double sine = length(q + 1), sign = q[0] < 0 ? -1 : 1, k = sine < 1e-8 ? 2 : 2 * atan2(sine, sign * q[0]) / sine;
  r[0] = r[1] = r[2] = 0;
  add(r, sign * k, q + 1);
}
static void matrix(double *R, const double *q) {
  double w = q[0], x = q[1], y = q[2], z = q[3];
  R[0] = 1 - 2 * (y * y + z * z), R[1] = 2 * (x * y - w * z), R[2] = 2 * (x * z + w * y);
  R[3] = 2 * (x * y + w * z), R[4] = 1 - 2 * (x * x + z * z), R[5] = 2 * (y * z - w * x);
  R[6] = 2 * (x * z - w * y), R[7] = 2 * (y * z + w * x), R[8] = 1 - 2 * (x * x + y * y);
}

/* ---- the body of a shape: docs/certificate.md, "Body" ---- */

/* The numbers of a body in the order of the certificate, and a contact point. */
typedef struct {
  double offset[3], mass, com[3], inertia[6], kp, kd, armature, bound, a[3], b[3], radius;
} Body;
typedef struct { double body, p[3], radius; } Point;
typedef struct {
  Body body[BODIES];
  Point point[POINTS];
  double axis[BODIES][3], centre[BODIES][4], half[BODIES][3]; /* of hinges; of ranges */
  int hinge[BODIES];
} Shape;

static void capsule(Body *o, double ax, double ay, double az, double bx, double by, double bz, double r) {
  o->a[0] = ax, o->a[1] = ay, o->a[2] = az, o->b[0] = bx, o->b[1] = by, o->b[2] = bz, o->radius = r;
}
static double ankle(const Shape *s, int i) { return .022 - s->body[i < 10 ? i + 3 : i].offset[1]; }

static void skeleton(Shape *s, const double *beta) { /* offsets and capsules */
  double size = 1 + .03 * beta[0], girth = size + .06 * beta[1], foot = size + .04 * beta[7];
  double hand = size + .03 * beta[4], head = size + .04 * beta[8], x, y, r;
  size_t k, j;
  int i;
  for (i = 0; i < BODIES; ++i) {
    const double *row = standard[row_of[i]];
    double gain[3];
    gain[0] = gain[1] = gain[2] = size;
    for (k = 0; k < sizeof gains / sizeof *gains; ++k)
      if (gains[k].part == (int)row[13]) gain[gains[k].axis] += gains[k].gain * beta[gains[k].beta];
    for (k = 0; k < 3; ++k) s->body[i].offset[k] = row[k] * gain[k];
    if (right_side[i]) s->body[i].offset[0] *= -1;
  }
  for (k = 0; k < 4; ++k) {
    x = size * trunk[k].x, y = size * trunk[k].y, r = size * trunk[k].z;
    capsule(&s->body[trunk[k].body], -x, y, r, x, y, r, girth * trunk[k].r);
  }
  for (k = 0; k < 6; ++k)
    for (i = 0; i < (k ? 2 : 1); ++i) {
      const double *bone = s->body[bones[k].child + i].offset;
      Body *o = &s->body[bones[k].body + i];
      for (j = 0; j < 3; ++j) o->a[j] = bones[k].from * bone[j], o->b[j] = bones[k].to * bone[j];
      o->radius = bones[k].r * girth;
      if (k == 1) o->radius = fmin(o->radius, fabs(o->offset[0] + o->a[0]) - .001);
    }
  capsule(&s->body[15], 0, .03 * head, 0, 0, .105 * head, 0, .085 * head);
  for (i = 0; i < 2; ++i) {
    const double *ball = s->body[10 + i].offset, side = i ? -1 : 1;
    r = .034 * size, y = r - ankle(s, 7 + i);
    capsule(&s->body[7 + i], 0, y, -.022 * foot, ball[0], y, ball[2] - .014 * foot, r);
    r = .020 * size, y = r - .022;
    capsule(&s->body[10 + i], 0, y, .012 * foot, 0, y, .052 * foot, r);
    capsule(&s->body[20 + i], .03 * side * hand, -.004, 0, .14 * side * hand, -.010, .004, .030 * hand);
  }
}
static double volume(const Body *o) {
  double d[3];
  copy(d, o->b);
  add(d, -1, o->a);
  return 3.14159265358979323846 * o->radius * o->radius * (length(d) + 4. / 3 * o->radius);
}
static void matter(Shape *s, const Shape *unit) { /* masses and inertias of solid capsules; joints */
  static const double side[3] = {1, -1, -1};
  double total = 0, d[3], h, r, ball, rod, along, across, rotation[3];
  int i, j, k, at;
  for (i = 0; i < BODIES; ++i) {
    Body *o = &s->body[i];
    const double *row = standard[row_of[i]];
    o->mass = 70 * row[3] * volume(o) / volume(&unit->body[i]);
    total += o->mass;
    copy(d, o->b);
    add(d, -1, o->a);
    h = length(d), r = o->radius, rod = o->mass * h / (h + 4. / 3 * r), ball = o->mass - rod;
    along = (.5 * rod + .4 * ball) * r * r;
    across = rod * (h * h / 12 + r * r / 4) + ball * (.4 * r * r + h * h / 4 + 3. / 8 * h * r);
    for (j = at = 0; j < 3; ++j) {
      o->com[j] = .5 * (o->a[j] + o->b[j]);
      for (k = j; k < 3; ++k) o->inertia[at++] = (j == k ? across : 0) + (along - across) * d[j] * d[k] / (h * h);
    }
  }
  for (i = 0; i < BODIES; ++i) {
    Body *o = &s->body[i];
    const double *row = standard[row_of[i]], degree = 3.14159265358979323846 / 180;
    o->kp = row[4] * total / 70, o->kd = .1 * o->kp, o->bound = row[5] * total / 70, o->armature = row[6];
    for (j = 0; j < 3; ++j) {
      rotation[j] = row[7 + j] * degree * (right_side[i] ? side[j] : 1);
      s->half[i][j] = 2 * sin(.5 * row[10 + j] * degree);
      s->axis[i][j] = 0;
    }
    exponential(s->centre[i], 1, rotation);
    s->hinge[i] = i == 4 || i == 5 || i == 18 || i == 19;
    if (s->hinge[i]) s->axis[i][i < 6 ? 0 : 1] = i == 18 ? -1 : 1;
  }
}
static void point(Shape *s, int *n, int body, double x, double y, double z, double radius) {
  Point *o = &s->point[(*n)++];
  o->body = body, o->p[0] = x, o->p[1] = y, o->p[2] = z, o->radius = radius;
}
static void points(Shape *s, const double *beta) {
  double size = 1 + .03 * beta[0], foot = size + .04 * beta[7];
  int n = 0, i;
  size_t k;
  for (i = 0; i < 2; ++i) {
    const double *ball = s->body[10 + i].offset, x = i ? -1 : 1, sole = -ankle(s, 7 + i);
    point(s, &n, 7 + i, -.026 * x * size, sole, -.052 * foot, 0);
    point(s, &n, 7 + i, .026 * x * size, sole, -.052 * foot, 0);
    point(s, &n, 7 + i, ball[0] - .040 * x * size, ball[1], ball[2], .022);
    point(s, &n, 7 + i, ball[0] + .040 * x * size, ball[1], ball[2], .022);
    point(s, &n, 10 + i, -.030 * x * size, -.022, .068 * foot, 0);
    point(s, &n, 10 + i, .030 * x * size, -.022, .062 * foot, 0);
  }
  for (i = 0; i < 2; ++i) {
    const double *ball = s->body[10 + i].offset;
    point(s, &n, 7 + i, ball[0], .036 * size - ankle(s, 7 + i), .6 * ball[2], .026 * size);
  }
  for (k = 0; k < sizeof spheres / sizeof *spheres; ++k) {
    const Body *o = &s->body[spheres[k].body];
    double t = spheres[k].along, u = 1 - t;
    point(s, &n, spheres[k].body, u * o->a[0] + t * o->b[0], u * o->a[1] + t * o->b[1], u * o->a[2] + t * o->b[2], o->radius);
  }
}

/* ---- rules: docs/certificate.md, "Rules" ---- */

static void note(Rule *rules, int rule, long step, double claimed, double found, double difference) {
  Rule *r = &rules[rule];
  if (r->step >= 0 && (difference <= r->difference || isnan(r->difference))) return;
  r->claimed = claimed, r->found = found, r->difference = difference, r->step = step;
}
static void note_numbers(Rule *rules, int rule, long step, double claimed, double found) {
  note(rules, rule, step, claimed, found, fabs(claimed - found));
}
static void note_vectors(Rule *rules, int rule, long step, const double *claimed, const double *found) {
  double d[3];
  copy(d, claimed);
  add(d, -1, found);
  note(rules, rule, step, length(claimed), length(found), length(d));
}

typedef struct { double push, pull, beyond, absent, depth, share, velocity, spin; } Totals;
typedef struct {
  double q[BODIES][4], R[BODIES][9], p[BODIES][3], w[BODIES][3], v[BODIES][3], alpha[BODIES][3], a[BODIES][3];
  double turn[BODIES][3], force[BODIES][3], moment[BODIES][3]; /* joint acceleration in child's axes; what joints carry */
} Motion;

/* Record: state p 3, q 22x4, v 3, w 22x3; v' 3, w' 22x3; targets q 21x4, w 21x3; torques 21x3; forces 37x3 */
static const double *joint_w(const double *x, int i) { return x + 94 + 3 * i; }

static void kinematics(const Shape *s, const double *x, Motion *m) {
  double joint[3], spin[3], r[3], c[3], R[9];
  int i, j;
  for (i = 0; i < BODIES; ++i) {
    normalise(m->q[i], x + 3 + 4 * i);
    for (j = 0; j < 3; ++j) m->turn[i][j] = 240 * (x[STATE + 3 + 3 * i + j] - joint_w(x, i)[j]);
    matrix(R, m->q[i]);
    if (i == 0) {
      memcpy(m->R[0], R, sizeof R);
      turn(m->w[0], R, joint_w(x, 0));
      turn(m->alpha[0], R, m->turn[0]);
      for (j = 0; j < 3; ++j) m->p[0][j] = x[j], m->v[0][j] = x[91 + j], m->a[0][j] = 240 * (x[STATE + j] - x[91 + j]);
    } else {
      int l = parent[i], k;
      for (j = 0; j < 3; ++j)
        for (k = 0; k < 3; ++k)
          m->R[i][3 * j + k] = m->R[l][3 * j] * R[k] + m->R[l][3 * j + 1] * R[3 + k] + m->R[l][3 * j + 2] * R[6 + k];
      turn(joint, m->R[i], joint_w(x, i));
      turn(spin, m->R[i], m->turn[i]);
      turn(r, m->R[l], s->body[i].offset);
      cross(c, m->w[l], r);
      copy(m->p[i], m->p[l]), add(m->p[i], 1, r);
      copy(m->v[i], m->v[l]), add(m->v[i], 1, c);
      copy(m->a[i], m->a[l]), add_cross(m->a[i], m->alpha[l], r), add_cross(m->a[i], m->w[l], c);
      copy(m->w[i], m->w[l]), add(m->w[i], 1, joint);
      copy(m->alpha[i], m->alpha[l]), add(m->alpha[i], 1, spin), add_cross(m->alpha[i], m->w[l], joint);
    }
  }
}
/* Takes a force at a point (from the body's joint) off what the joints must carry. */
static void external(Motion *m, int i, const double *arm, const double *f) {
  double n[3];
  cross(n, arm, f);
  add(m->force[i], -1, f), add(m->moment[i], -1, n);
}
static void inertial(const Shape *s, Motion *m) { /* F = m (a_c + g z), N = I alpha + w x I w, about the joint */
  double d[3], c[3], f[3], w[3], alpha[3], Iw[3], Ia[3];
  int i, j;
  for (i = 0; i < BODIES; ++i) {
    const Body *o = &s->body[i];
    const double *I = o->inertia;
    turn(d, m->R[i], o->com);
    cross(c, m->w[i], d);
    copy(f, m->a[i]), add_cross(f, m->alpha[i], d), add_cross(f, m->w[i], c);
    f[2] += page_constants[1];
    turn_back(w, m->R[i], m->w[i]), turn_back(alpha, m->R[i], m->alpha[i]);
    for (j = 0; j < 3; ++j) f[j] *= o->mass;
    Iw[0] = I[0] * w[0] + I[1] * w[1] + I[2] * w[2], Ia[0] = I[0] * alpha[0] + I[1] * alpha[1] + I[2] * alpha[2];
    Iw[1] = I[1] * w[0] + I[3] * w[1] + I[4] * w[2], Ia[1] = I[1] * alpha[0] + I[3] * alpha[1] + I[4] * alpha[2];
    Iw[2] = I[2] * w[0] + I[4] * w[1] + I[5] * w[2], Ia[2] = I[2] * alpha[0] + I[4] * alpha[1] + I[5] * alpha[2];
    add_cross(Ia, w, Iw);
    copy(m->force[i], f);
    turn(m->moment[i], m->R[i], Ia), add_cross(m->moment[i], d, f);
  }
}

static void floor_rules(const Shape *s, const double *forces, Motion *m, long step, Rule *rules, Totals *t) {
  double k = page_constants[2], damping = page_constants[3] + k / 240, arm[3], v[3], c[3], a[3], depth, law, slip, along, push, side;
  int n, i;
  for (n = 0; n < POINTS; ++n) {
    const double *f = forces + 3 * n;
    i = (int)s->point[n].body;
    turn(arm, m->R[i], s->point[n].p);
    arm[2] -= s->point[n].radius;
    depth = page_constants[6] - m->p[i][2] - arm[2];
    t->depth = fmax(t->depth, depth - page_constants[6]);
    if (!(depth > 0)) {
      note(rules, AIR, step, length(f), 0, length(f));
      continue;
    }
    cross(c, m->w[i], arm); /* the point's velocity at the end of the step */
    copy(v, m->v[i]), add(v, 1, c), add(v, 1. / 240, m->a[i]);
    cross(a, m->alpha[i], arm), add_cross(a, m->w[i], c), add(v, 1. / 240, a);
    law = k * depth - damping * v[2];
    if (f[0] == 0 && f[1] == 0 && f[2] == 0) {
      t->absent += fmax(law, 0);
      continue;
    }
    note_numbers(rules, NORMAL, step, f[2], law);
    slip = hypot(v[0], v[1]), side = hypot(f[0], f[1]), push = fmax(f[2], 0);
    along = slip > 0 ? -(f[0] * v[0] + f[1] * v[1]) / slip : side; /* friction opposes slip */
    note(rules, SIDEWAYS, step, side, along,
         slip > 0 ? hypot(f[0] + along * v[0] / slip, f[1] + along * v[1] / slip) + fmax(-along, 0) : side);
    t->push += push, t->pull += fmax(-f[2], 0), t->beyond += fmax(side - page_constants[4] * push, 0);
    external(m, i, arm, f);
  }
}

static double clamp(double x) { return fmin(fmax(x, 0), 1); }
static void self_contact(const Shape *s, Motion *m) {
  double start[2][3], axis[2][3], point_[3], gap[3], arm[2][3], v[2][3], c[3], f[3], b, a, e, g, h, t, u, distance, depth, push;
  int n, j;
  for (n = 0; n < PAIRS; ++n) {
    const int *pair = self_pairs[n];
    double reach = s->body[pair[0]].radius + s->body[pair[1]].radius;
    for (j = 0; j < 2; ++j) {
      const Body *o = &s->body[pair[j]];
      turn(start[j], m->R[pair[j]], o->a), add(start[j], 1, m->p[pair[j]]);
      copy(c, o->b), add(c, -1, o->a), turn(axis[j], m->R[pair[j]], c);
    }
    copy(gap, start[0]), add(gap, -1, start[1]);
    if (length(gap) > reach + length(axis[0]) + length(axis[1])) continue;
    a = fmax(dot(axis[0], axis[0]), 1e-9), e = fmax(dot(axis[1], axis[1]), 1e-9), b = dot(axis[0], axis[1]);
    g = dot(axis[0], gap), h = dot(axis[1], gap);
    t = clamp((b * h - g * e) / fmax(a * e - b * b, 1e-9));
    u = (b * t + h) / e;
    if (u < 0 || u > 1) t = clamp((b * clamp(u) - g) / a);
    u = clamp(u);
    add(gap, t, axis[0]), add(gap, -u, axis[1]);
    distance = fmax(length(gap), 1e-6), depth = reach - distance;
    if (!(depth > 0)) continue;
    copy(point_, start[1]), add(point_, u, axis[1]), add(point_, (s->body[pair[1]].radius - .5 * depth) / distance, gap);
    for (j = 0; j < 2; ++j) {
      copy(arm[j], point_), add(arm[j], -1, m->p[pair[j]]);
      copy(v[j], m->v[pair[j]]), add_cross(v[j], m->w[pair[j]], arm[j]);
    }
    add(v[0], -1, v[1]);
    push = fmax(page_constants[7] * depth - page_constants[8] * dot(v[0], gap) / distance, 0);
    f[0] = f[1] = f[2] = 0;
    add(f, push / distance, gap), external(m, pair[0], arm[0], f);
    add(f, -2 * push / distance, gap), external(m, pair[1], arm[1], f);
  }
}

static void joint_rules(const Shape *s, const double *x, Motion *m, long step, Rule *rules, Totals *t) {
  const double *target = x + STATE + 69 - 4, *feed = x + STATE + 69 + 84 - 3, *torque = x + STATE + 69 + 147 - 3, zero[3] = {0, 0, 0};
  double phi[3], q[4], law[3], found[3], r[3], g, slope, excess, dt = 1. / 240, size, k = page_constants[9];
  double gain = page_constants[10] + dt * k;
  int i, j;
  for (i = BODIES - 1; i > 0; --i) {
    const Body *o = &s->body[i];
    const double *tau = torque + 3 * i, *w = joint_w(x, i);
    normalise(q, target + 4 * i);
    product(q, -1, m->q[i], q);
    logarithm(phi, q);
    for (j = 0; j < 3; ++j)
      law[j] = o->kp * (phi[j] - dt * w[j] - dt * dt * m->turn[i][j]) + o->kd * (feed[3 * i + j] - w[j] - dt * m->turn[i][j]);
    size = length(tau);
    t->share = fmax(t->share, size / o->bound);
    note(rules, BOUND, step, size / o->bound, 1, fmax(size / o->bound - 1, 0));
    if (fabs(size / o->bound - 1) > 1e-9) note_vectors(rules, LAW, step, tau, law);
    turn_back(found, m->R[i], m->moment[i]); /* less range and armature */
    product(q, -1, s->centre[i], m->q[i]);
    for (j = 0; j < 3; ++j) r[j] = (q[0] < 0 ? -2 : 2) * q[1 + j] / s->half[i][j];
    g = length(r);
    add(found, o->armature, m->turn[i]);
    if (g > 1) {
      for (j = 0; j < 3; ++j) r[j] /= s->half[i][j];
      slope = fmax(length(r), 1e-6), excess = (g - 1) * g / slope;
      add(found, k * excess / slope, r), add(found, gain, w), add(found, gain * dt, m->turn[i]);
    }
    if (s->hinge[i]) {
      double is = dot(found, s->axis[i]), said = dot(tau, s->axis[i]);
      note_numbers(rules, JOINT, step, said, is);
    } else {
      note_vectors(rules, JOINT, step, tau, found);
    }
    copy(r, m->p[i]), add(r, -1, m->p[parent[i]]);
    add(m->force[parent[i]], 1, m->force[i]);
    add(m->moment[parent[i]], 1, m->moment[i]), add_cross(m->moment[parent[i]], r, m->force[i]);
  }
  note_vectors(rules, FORCE, step, zero, m->force[0]);
  note_vectors(rules, MOMENT, step, zero, m->moment[0]);
}

static void state_rules(const Shape *s, const double *x, long step, Rule *rules) {
  int i, j;
  for (i = 0; i < BODIES; ++i) {
    const double *q = x + 3 + 4 * i;
    double n = sqrt(q[0] * q[0] + dot(q + 1, q + 1));
    note_numbers(rules, UNIT, step, n, 1);
    if (s->hinge[i])
      for (j = 0; j < 3; ++j)
        if (s->axis[i][j] == 0) note_numbers(rules, AXIS, step, 2 * q[1 + j], 0), note_numbers(rules, AXIS, step, joint_w(x, i)[j], 0);
  }
}
static void step_rules(const double *x, const double *next, long step, Rule *rules, Totals *t) {
  double p[3], q[4], to[4], r[3];
  int i;
  copy(p, x), add(p, 1. / 240, next + 91);
  note_vectors(rules, POSITION, step, next, p);
  note_vectors(rules, VELOCITY, step, next + 91, x + STATE);
  copy(p, next + 91), add(p, -1, x + STATE), t->velocity += length(p);
  for (i = 0; i < BODIES; ++i) {
    exponential(q, 1. / 240, joint_w(next, i));
    product(q, 1, x + 3 + 4 * i, q);
    product(to, -1, q, next + 3 + 4 * i);
    logarithm(r, to);
    note(rules, ROTATION, step, 0, length(r), length(r));
    note_vectors(rules, SPIN, step, joint_w(next, i), x + STATE + 3 + 3 * i);
    copy(r, joint_w(next, i)), add(r, -1, x + STATE + 3 + 3 * i), t->spin += length(r) / BODIES;
  }
}

/* ---- one certificate ---- */
typedef struct { const unsigned char *numbers, *steps, *poses, *trans; uint64_t count; long stride, columns; } Certificate;

/* What is wrong with the file itself, or NULL. */
static const char *open_certificate(const unsigned char *file, size_t size, Certificate *c) {
  unsigned char hash[32];
  uint64_t name, start;
  if (size < 8 || memcmp(file, "MIMICERT", 8)) return "not a certificate";
  if (size < FIXED + 8 * NUMBERS + 8 * STATE + 32) return "shorter than a certificate";
  if (integer(file + 8, 4) != 1) return "a version of the format other than 1";
  if (integer(file + 16, 8) != size) return "size differs from the recorded one";
  c->count = integer(file + 24, 8), c->stride = (long)integer(file + 32, 4);
  if (integer(file + 36, 4) != 0) return "plates, which version 1 does not have";
  if (integer(file + 40, 4) != POINTS) return "another number of contact points";
  name = integer(file + 44, 4), start = FIXED + 8 * NUMBERS + (name + 7) / 8 * 8;
  if (name < 1 || name > 4096) return "a name of no or too many bytes";
  if (integer(file + 12, 4) != start) return "start of the steps differs from the length of the header";
  if (c->count < 1 || c->count > 1u << 24) return "no or too many steps";
  if (c->stride < 1 || c->stride > 240 || c->count % (uint64_t)c->stride) return "frames do not divide the steps";
  if (start + 8 * (c->count * RECORD + STATE) + 32 != size) return "size differs from the number of steps";
  sha256(file, size - 32, hash);
  if (memcmp(hash, file + size - 32, 32)) return "hash differs";
  c->numbers = file + FIXED, c->steps = file + start;
  return NULL;
}
static void read_numbers(const unsigned char *p, long count, double *out, long step, Rule *rules) {
  long i;
  for (i = 0; i < count; ++i) {
    out[i] = number(p + 8 * i);
    if (!(fabs(out[i]) < 1e9)) note(rules, FINITE, step, out[i], 0, 1), out[i] = 0;
  }
}

/* The doubles of a stored member of an .npz (zip, then .npy) and their number, or NULL; there must be one. */
static const unsigned char *member(const unsigned char *zip, size_t size, const char *name, uint64_t *count) {
  const unsigned char *found = NULL;
  size_t at = 0, wanted = strlen(name), head, i;
  while (at + 30 <= size && !memcmp(zip + at, "PK\3\4", 4)) {
    uint64_t bytes = integer(zip + at + 22, 4), names = integer(zip + at + 26, 2), extra = integer(zip + at + 28, 2);
    size_t data = at + 30 + names + extra;
    if (data > size || integer(zip + at + 6, 2) & 8 || integer(zip + at + 8, 2)) return NULL;
    if (bytes == 0xffffffffu) bytes = extra >= 20 ? integer(zip + at + 30 + names + 4, 8) : size; /* zip64 */
    if (bytes > size - data) return NULL;
    if (names == wanted && !memcmp(zip + at + 30, name, wanted)) {
      if (found || bytes < 10 || memcmp(zip + data, "\x93NUMPY\1", 7)) return NULL;
      head = 10 + integer(zip + data + 8, 2);
      for (i = 10; i + 5 < head && head <= bytes && !found; ++i)
        if (!memcmp(zip + data + i, "'<f8'", 5)) found = zip + data + head, *count = (bytes - head) / 8;
      if (!found) return NULL;
    }
    at = data + (size_t)bytes;
  }
  return found;
}
static void frame_rule(const Certificate *c, const double *x, uint64_t step, Rule *rules) {
  static const double rest[3] = {.003, -.351, .012}; /* pelvis = trans + rest */
  uint64_t frame = step / (uint64_t)c->stride;
  double p[3], r[3], q[4];
  int i, j;
  for (j = 0; j < 3; ++j) p[j] = rest[j] + number(c->trans + 8 * (3 * frame + (unsigned)j));
  note_vectors(rules, FRAMES, (long)step, x, p);
  for (i = 0; i < BODIES; ++i) {
    for (j = 0; j < 3; ++j) r[j] = number(c->poses + 8 * (frame * (uint64_t)c->columns + (unsigned)(3 * i + j)));
    exponential(q, 1, r);
    product(q, -1, q, x + 3 + 4 * i);
    logarithm(r, q);
    note(rules, FRAMES, (long)step, 0, length(r), length(r));
  }
}
/* Binds the motion file: its hash, rate and shape, and its frames, which judge() compares. */
static void open_motion(const unsigned char *file, const unsigned char *motion, size_t size, Certificate *c, Rule *rules) {
  const unsigned char *rate, *shape;
  unsigned char hash[32];
  uint64_t frames = c->count / (uint64_t)c->stride + 1, poses = 0, trans = 0, rates = 0, shapes = 0, i;
  sha256(motion, size, hash);
  note_numbers(rules, MOTION_FILE, 0, memcmp(hash, file + 48, 32) != 0, 0);
  c->poses = member(motion, size, "poses.npy", &poses), c->trans = member(motion, size, "trans.npy", &trans);
  rate = member(motion, size, "mocap_framerate.npy", &rates), shape = member(motion, size, "betas.npy", &shapes);
  c->columns = (long)(poses / frames);
  if (!c->poses || !c->trans || !rate || !shape || poses % frames || c->columns < 3 * BODIES || trans != 3 * frames ||
      rates != 1 || shapes < BETAS)
    note(rules, FRAMES, 0, 0, HUGE_VAL, HUGE_VAL), c->poses = NULL;
  else
    for (note_numbers(rules, FRAMES, 0, 240. / (double)c->stride, number(rate)), i = 0; i < BETAS; ++i)
      note_numbers(rules, FRAMES, 0, number(c->numbers + 8 * (CONSTANTS + i)), number(shape + 8 * i));
}

static int judge(const Certificate *c, Rule *rules) {
  static double head[NUMBERS], record[2][RECORD], zero[BETAS];
  static Shape shape, unit;
  static Motion m;
  const double *beta = head + CONSTANTS, *claims = beta + BETAS, *said = claims + CLAIMS, *own;
  Totals t = {0, 0, 0, 0, 0, 0, 0, 0};
  double found[CLAIMS], largest = 0;
  uint64_t step;
  int i, status = ACCEPTED;
  read_numbers(c->numbers, NUMBERS, head, 0, rules);
  for (i = 0; i < CONSTANTS; ++i) note_numbers(rules, CONSTANT, 0, head[i], page_constants[i]);
  for (i = 0; i < BETAS; ++i) largest = fmax(largest, fabs(beta[i]));
  note(rules, SHAPE, 0, largest, 5, fmax(largest - 5, 0));
  skeleton(&unit, zero), skeleton(&shape, beta), matter(&shape, &unit), points(&shape, beta);
  for (own = (const double *)shape.body, i = 0; i < BODIES * PER_BODY; ++i) note_numbers(rules, SHAPE, 0, said[i], own[i]);
  for (said += i, own = (const double *)shape.point, i = 0; i < POINTS * 5; ++i) note_numbers(rules, SHAPE, 0, said[i], own[i]);
  read_numbers(c->steps, RECORD, record[0], 0, rules);
  for (step = 0; step < c->count; ++step) {
    double *x = record[step % 2], *next = record[(step + 1) % 2];
    long k = (long)step;
    read_numbers(c->steps + 8 * RECORD * (step + 1), step + 1 < c->count ? RECORD : STATE, next, k + 1, rules);
    if (c->poses && step % (uint64_t)c->stride == 0) frame_rule(c, x, step, rules);
    state_rules(&shape, x, k, rules);
    kinematics(&shape, x, &m);
    inertial(&shape, &m);
    floor_rules(&shape, x + RECORD - 3 * POINTS, &m, k, rules, &t);
    self_contact(&shape, &m);
    joint_rules(&shape, x, &m, k, rules, &t);
    step_rules(x, next, k, rules, &t);
  }
  state_rules(&shape, record[step % 2], (long)step, rules);
  if (c->poses) frame_rule(c, record[step % 2], step, rules);
  t.push = fmax(t.push, 1);
  found[0] = t.share, found[1] = t.beyond / t.push, found[2] = t.pull / t.push, found[3] = t.depth;
  t.velocity /= (double)c->count, t.spin /= (double)c->count;
  note(rules, MEAN_VELOCITY, 0, 0, t.velocity, t.velocity);
  note(rules, MEAN_SPIN, 0, 0, t.spin, t.spin);
  note(rules, CONE, 0, claims[1], found[1], found[1]);
  note(rules, PULL, 0, claims[2], found[2], found[2]);
  note(rules, ABSENT, 0, 0, t.absent / t.push, t.absent / t.push);
  note(rules, DEPTH, 0, claims[3], found[3], found[3]);
  for (i = 0; i < CLAIMS; ++i) note_numbers(rules, CLAIM, 0, claims[i], found[i]);
  for (i = 0; i < RULES; ++i)
    if (rules[i].step >= 0 && !(rules[i].difference <= rules[i].tolerance)) status = REJECTED;
  return status;
}

int verify_bytes(const unsigned char *file, size_t size, const unsigned char *motion, size_t motion_size, Rule *rules,
                 const char **wrong) {
  Certificate c = {NULL, NULL, NULL, NULL, 0, 0, 0};
  int i;
  *wrong = open_certificate(file, size, &c);
  if (*wrong) return BROKEN;
  for (i = 0; i < RULES; ++i) {
    Rule empty = {NULL, NULL, 0, 0, 0, 0, -1};
    empty.name = rule_list[i].name, empty.unit = rule_list[i].unit, empty.tolerance = rule_list[i].tolerance;
    rules[i] = empty;
  }
  if (motion) open_motion(file, motion, motion_size, &c, rules);
  return judge(&c, rules);
}
