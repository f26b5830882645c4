/* The numbers of docs/certificate.md that verify.c needs: constants, the body's tables, rules. */
enum { BODIES = 22, POINTS = 37, PAIRS = 50, CONSTANTS = 11, BETAS = 10, CLAIMS = 4, PER_BODY = 24 };

/* SHA-256: first bits of the cube roots of the first 64 primes (FIPS 180-4, 4.2.2) */
static const uint32_t K[64] = {
    0x428a2f98, 0x71374491, 0xb5c0fbcf, 0xe9b5dba5, 0x3956c25b, 0x59f111f1, 0x923f82a4, 0xab1c5ed5, 0xd807aa98, 0x12835b01,
    0x243185be, 0x550c7dc3, 0x72be5d74, 0x80deb1fe, 0x9bdc06a7, 0xc19bf174, 0xe49b69c1, 0xefbe4786, 0x0fc19dc6, 0x240ca1cc,
    0x2de92c6f, 0x4a7484aa, 0x5cb0a9dc, 0x76f988da, 0x983e5152, 0xa831c66d, 0xb00327c8, 0xbf597fc7, 0xc6e00bf3, 0xd5a79147,
    0x06ca6351, 0x14292967, 0x27b70a85, 0x2e1b2138, 0x4d2c6dfc, 0x53380d13, 0x650a7354, 0x766a0abb, 0x81c2c92e, 0x92722c85,
    0xa2bfe8a1, 0xa81a664b, 0xc24b8b70, 0xc76c51a3, 0xd192e819, 0xd6990624, 0xf40e3585, 0x106aa070, 0x19a4c116, 0x1e376c08,
    0x2748774c, 0x34b0bcb5, 0x391c0cb3, 0x4ed8aa4a, 0x5b9cca4f, 0x682e6ff3, 0x748f82ee, 0x78a5636f, 0x84c87814, 0x8cc70208,
    0x90befffa, 0xa4506ceb, 0xbef9a3f7, 0xc67178f2};

/* rate, gravity, floor's stiffness and damping, friction, slip speed, skin, stiffness and damping of self contact
 * and of ranges */
static const double page_constants[CONSTANTS] = {240, 9.81, 4e5, 4e3, 1, .002, .0008, 1e4, 30, 5000, 50};

static const int parent[BODIES] = {-1, 0, 0, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 9, 9, 12, 13, 14, 16, 17, 18, 19};
/* row of the table below, its part of the shape; bodies of the right side follow the left */
static const int row_of[BODIES] = {0, 6, 6, 1, 7, 7, 2, 8, 8, 3, 9, 9, 4, 10, 10, 5, 11, 11, 12, 12, 13, 13};
static const int right_side[BODIES] = {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 1, 0, 1};
/* offset from the parent, mass share, kp, bound, armature, centre and half axes of the range in degrees, part */
static const double standard[14][15] = {
    {0, 0, 0, .118, 0, 0, 0, 0, 0, 0, 1, 1, 1, 0},
    {0, .108, -.026, .082, 1000, 250, .02, 10, 0, 0, 50, 45, 45, 0},
    {0, .136, .001, .082, 1000, 250, .02, 10, 0, 0, 50, 45, 45, 0},
    {0, .054, .026, .112, 1000, 250, .02, 10, 0, 0, 50, 45, 45, 0},
    {0, .214, -.042, .012, 150, 50, .01, 0, 0, 0, 55, 65, 50, 6},
    {0, .066, .050, .056, 100, 40, .01, 0, 0, 0, 55, 65, 50, 6},
    {.066, -.088, -.006, .1446, 500, 250, .02, -45, 0, 10, 95, 75, 75, 1},
    {.040, -.382, -.004, .0457, 500, 220, .02, 75, 0, 0, 82, 82, 82, 2},
    {-.012, -.402, -.040, .0113, 400, 160, .02, 12, 0, 0, 62, 60, 50, 2},
    {.024, -.056, .122, .0022, 100, 40, .01, -15, 0, 0, 65, 30, 30, 3},
    {.074, .118, -.034, .0204, 500, 130, .02, 0, 0, 5, 45, 45, 45, 4},
    {.096, .034, -.010, .0263, 400, 120, .02, 0, -25, -10, 130, 125, 130, 4},
    {.258, -.014, -.026, .0150, 300, 80, .02, 0, -77, 0, 85, 85, 85, 5},
    {.250, .008, -.001, .0035, 80, 20, .01, 0, 0, 0, 140, 90, 95, 5}};
/* gains of the parts torso, hip, leg, foot, shoulder, arm, head: shape parameter, axis, gain; all: parameter 0 */
static const struct { int part, beta, axis; double gain; } gains[] = {
    {0, 3, 1, .03}, {0, 9, 1, -.02}, {1, 6, 0, .04}, {2, 2, 1, .03}, {2, 9, 1, .02}, {3, 7, 2, .04},
    {4, 3, 1, .02}, {4, 5, 0, .05}, {5, 4, 0, .03}, {6, 8, 0, .04}, {6, 8, 1, .04}, {6, 8, 2, .04}};
static const struct { int body; double x, y, z, r; } trunk[] = {
    {0, .062, -.02, -.018, .105}, {3, .050, .04, .022, .105}, {6, .055, .02, .012, .105}, {9, .070, .09, -.015, .110}};
static const struct { int body, child; double from, to, r; } bones[] = {
    {12, 15, 0, 1, .050},     {1, 4, .20, .95, .064},   {4, 7, .05, .92, .046},
    {13, 16, .15, .85, .052}, {16, 18, .10, .95, .045}, {18, 20, .05, .95, .036}};
static const int self_pairs[PAIRS][2] = {
    {18, 0}, {18, 3}, {18, 6}, {18, 9}, {18, 15}, {18, 1}, {18, 2}, {19, 0}, {19, 3}, {19, 6}, {19, 9}, {19, 15}, {19, 1},
    {19, 2}, {20, 0}, {20, 3}, {20, 6}, {20, 9}, {20, 15}, {20, 1}, {20, 2}, {20, 4}, {20, 5}, {20, 7}, {20, 8}, {21, 0},
    {21, 3}, {21, 6}, {21, 9}, {21, 15}, {21, 1}, {21, 2}, {21, 4}, {21, 5}, {21, 7}, {21, 8}, {20, 21}, {20, 19}, {18, 21},
    {18, 19}, {1, 2}, {1, 5}, {4, 2}, {4, 5}, {7, 8}, {7, 5}, {4, 8}, {10, 8}, {7, 11}, {10, 11}};
/* contact points on the axes of capsules: body, share of the axis */
static const struct { int body; double along; } spheres[] = {
    {0, 0}, {0, 1}, {9, 0}, {9, 1}, {15, 0}, {15, 1}, {20, 0}, {20, 1}, {21, 0}, {21, 1}, {3, .5}, {6, .5}, {12, .5},
    {1, .5}, {2, .5}, {4, 0}, {5, 0}, {18, 0}, {19, 0}, {13, .8}, {14, .8}, {16, .3}, {17, .3}};
/* rules in the order of verify.h, units, tolerances */
static const struct { const char *name, *unit; double tolerance; } rule_list[RULES] = {
    {"motion file's hash", "", 0}, {"motion's frames", "m, rad", 1e-5}, {"constants", "SI", 1e-9},
    {"body of the shape", "SI", 1e-9}, {"finite numbers", "", 0}, {"unit quaternions", "", 1e-6},
    {"hinge axes", "rad, rad/s", 1e-3}, {"pelvis position", "m", 1e-5}, {"joint rotations", "rad", 1e-5},
    {"pelvis velocity", "m/s", 0.01}, {"joint velocities", "rad/s", 1}, {"mean pelvis velocity", "m/s", 2e-5},
    {"mean joint velocity", "rad/s", 3e-4}, {"force from nowhere", "N", 1e-5}, {"moment from nowhere", "N m", 1e-5},
    {"joint torques", "N m", 1e-5}, {"PD law", "N m", 1e-6}, {"torque bounds", "of it", 1e-9},
    {"force in the air", "N", 1e-9}, {"floor's push", "N", 1e-5}, {"friction against slip", "N", 1e-5},
    {"friction beyond cone", "of push", 0.1}, {"pull of the floor", "of push", 0.1}, {"push left out", "of push", 0.1},
    {"depth in the floor", "m", 0.05}, {"claims", "", 1e-6}};
