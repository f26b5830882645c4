/* The numbers of docs/certificate.md: "Constants", "Body", the pairs of "Self contact", and "Rules". */
#define COUNT(table) ((int)(sizeof(table) / sizeof(table)[0]))

enum { BODIES = 22, JOINTS = 21, POINTS = 37, SHAPES = 10, MOST_PLATES = 64 };
typedef struct { double x, y, z; } Vec;

/* "Constants", and the micrometre of "Ground". */
static const double PI = 3.14159265358979323846, RATE = 240, GRAVITY = 9.81, FLOOR_K = 4e5, FLOOR_C = 4e3, FRICTION = 1,
                    SLIP_SPEED = 0.002, SKIN = 0.0008, SELF_K = 1e4, SELF_C = 30, RANGE_K = 5000, RANGE_C = 50,
                    PLATE_REACH = 0.08, PLATE_PUSH = 4000, FIRST_TOUCH = 1e-6;
/* "Format": the least and the greatest value of each number of a plate. */
static const double PLATE_RANGE[][2] = {
    {-1e4, 1e4}, {-1e4, 1e4}, {-7, 7}, {0.01, 1000}, {0.01, 1000}, {0.01, 10}, {2e3, 1e7}, {1, 1e6}};
/* "Body": the parent of each body, and the left body of which it is the mirror image. Itself: it has none. */
static const int PARENT[BODIES] = {0, 0, 0, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 9, 9, 12, 13, 14, 16, 17, 18, 19};
static const int LEFT_OF[BODIES] = {0, 1, 1, 3, 4, 4, 6, 7, 7, 9, 10, 10, 12, 13, 13, 15, 16, 16, 18, 18, 20, 20};
/* "Body": the rows of its table, by body. A hinge has an axis, of any sign; others have none. Then "Centre of mass" and
 * "Inertia": of the trunk z of the centre; of a limb, in the row of its child, centre along the bone and behind it
 * and radii of gyration across and along it, in its length. */
typedef enum { TORSO, HEAD, HIP, LEG, FOOT, SHOULDER, ARM } Part;
typedef struct { Vec offset; double share, kp, bound, armature; Vec range_centre, range_half, hinge; Part part;
    double centre, behind, across, along; } Row;
static const Row ROWS[BODIES] = {
    [0] = {{0}, .118, 0, 0, 0, {0}, {0}, {0}, TORSO, -.022, 0, 0, 0},
    [3] = {{0, .108, -.026}, .082, 1000, 250, .02, {10, 0, 0}, {50, 45, 45}, {0}, TORSO, -.010, 0, 0, 0},
    [6] = {{0, .136, .001}, .082, 1000, 250, .02, {10, 0, 0}, {50, 45, 45}, {0}, TORSO, -.019, 0, 0, 0},
    [9] = {{0, .054, .026}, .112, 1000, 250, .02, {10, 0, 0}, {50, 45, 45}, {0}, TORSO, -.054, 0, 0, 0},
    [12] = {{0, .214, -.042}, .012, 150, 50, .01, {0}, {55, 65, 50}, {0}, HEAD, 0, 0, 0, 0},
    [15] = {{0, .066, .050}, .056, 100, 40, .01, {0}, {55, 65, 50}, {0}, HEAD, 0, 0, 0, 0},
    [1] = {{.066, -.088, -.006}, .1446, 500, 250, .02, {-45, 0, 10}, {95, 75, 75}, {0}, HIP, 0, 0, 0, 0},
    [4] = {{.04, -.382, -.004}, .0457, 500, 220, .02, {75, 0, 0}, {82, 82, 82}, {1, 0, 0}, LEG, .385, .059, .348, .156},
    [7] = {{-.012, -.402, -.040}, .0113, 400, 200, .02, {12, 0, 0}, {62, 60, 50}, {0}, LEG, .444, .0485, .260, .098},
    [10] = {{.024, -.056, .122}, .0022, 100, 40, .01, {-15, 0, 0}, {65, 30, 30}, {0}, FOOT, 0, 0, 0, 0},
    [13] = {{.074, .118, -.034}, .0181, 500, 130, .02, {0, 0, 5}, {45, 45, 45}, {0}, SHOULDER, 0, 0, 0, 0},
    [16] = {{.096, .034, -.010}, .0263, 400, 120, .02, {0, -25, -10}, {130, 125, 130}, {0}, SHOULDER, 0, 0, 0, 0},
    [18] = {{.258, -.014, -.026}, .0150, 300, 80, .02, {0, -77, 0}, {85, 85, 85}, {0, 1, 0}, ARM, .576, 0, .273, .153},
    [20] = {{.250, .008, -.001}, .0058, 80, 20, .01, {0}, {140, 90, 95}, {0}, ARM, .457, 0, .265, .108}};
/* "Capsules" of the trunk and along bones: ends and radius, and the child that the bone leads to, 0 if it is none. */
static const struct { int body, child; Vec from, to; double radius; } CAPSULES[] = {
    {0, 0, {-.062, -.02, -.018}, {.062, -.02, -.018}, .105}, {3, 0, {-.050, .04, .022}, {.050, .04, .022}, .105},
    {6, 0, {-.055, .02, .012}, {.055, .02, .012}, .105}, {9, 0, {-.070, .09, -.015}, {.070, .09, -.015}, .110},
    {12, 15, {0, 0, 0}, {1, 1, 1}, .050}, {1, 4, {.20, .20, .20}, {.95, .95, .95}, .064},
    {4, 7, {.05, .05, .05}, {.92, .92, .92}, .046}, {13, 16, {.15, .15, .15}, {.85, .85, .85}, .052},
    {16, 18, {.10, .10, .10}, {.95, .95, .95}, .045}, {18, 20, {.05, .05, .05}, {.95, .95, .95}, .036}};
/* "Contact points": spheres on the axes of capsules, at these shares of the axis. */
static const struct { int body; double share; } SPHERES[] = {
    {9, 0}, {9, 1}, {15, 0}, {15, 1}, {20, 0}, {20, 1}, {21, 0}, {21, 1}, {3, .5}, {6, .5}, {12, .5},
    {1, .5}, {2, .5}, {4, 0}, {5, 0}, {18, 0}, {19, 0}, {13, .8}, {14, .8}, {16, .3}, {17, .3}};
/* "Self contact": the first bodies of pairs, and the second bodies of each. */
static const struct { int first, count, second[13]; } PAIRS[] = {
    {18, 9, {0, 3, 6, 9, 15, 1, 2, 19, 21}}, {20, 13, {0, 3, 6, 9, 15, 1, 2, 4, 5, 7, 8, 19, 21}},
    {19, 7, {0, 3, 6, 9, 15, 1, 2}}, {21, 11, {0, 3, 6, 9, 15, 1, 2, 4, 5, 7, 8}},
    {1, 2, {2, 5}}, {4, 3, {2, 5, 8}}, {7, 3, {5, 8, 11}}, {10, 2, {8, 11}}};
/* "Rules": their names, units and tolerances. */
static const struct { const char *name, *unit; double tolerance; } RULE_TABLE[] = {
    {"motion file has the bound hash", "", 0}, {"rate, shape and frames of the motion file", "m, rad", 1e-5},
    {"constants", "SI", 1e-9}, {"body of the shape", "SI", 1e-9}, {"numbers finite, below 1e9", "", 0},
    {"quaternions of unit length", "", 1e-6}, {"hinges turn about their axes", "rad, rad/s", 1e-3},
    {"next place of the pelvis", "m", 1e-5}, {"next rotations", "rad", 1e-5},
    {"next velocity of the pelvis", "m/s", 0.01}, {"next angular velocities", "rad/s", 1},
    {"mean difference of velocity", "m/s", 2e-5}, {"mean difference of angular velocity", "rad/s", 3e-4},
    {"force from nowhere, at the pelvis", "N", 1e-5}, {"moment from nowhere, at the pelvis", "N m", 1e-5},
    {"joints carry their torques", "N m", 1e-5}, {"controller's law", "N m", 1e-6},
    {"bounds of the torques", "", 1e-9}, {"no force on a point in the air", "N", 1e-9},
    {"ground's push by its law, or no force", "N", 1e-5}, {"friction against the slip", "N", 1e-5},
    {"friction beyond its cone, of the push", "", 0.1}, {"pull of the ground, of the push", "", 0.1},
    {"push that is absent, of the push", "", 0.2}, {"deepest point in the floor", "m", 0.05}, {"claims", "", 1e-6},
    {"plates of the motion file, in their ranges", "", 0}};
