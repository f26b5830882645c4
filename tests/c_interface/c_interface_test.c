/* The C interface as a C program meets it.
 *   test_c_interface MIMICX MOTION.npz     the program, to compare bytes with, and a motion with keypoints */
#define _POSIX_C_SOURCE 200809L
#include <math.h>
#include <mimicx.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int problems = 0;

#define CHECK(holds, ...)                                \
  do {                                                   \
    if (!(holds)) {                                      \
      printf("%s:%d: %s: ", __FILE__, __LINE__, #holds); \
      printf(__VA_ARGS__);                               \
      printf("\n");                                      \
      ++problems;                                        \
    }                                                    \
  } while (0)

typedef struct {
  char* data;
  size_t size;
} Bytes;

static Bytes read_file(const char* path) {
  Bytes bytes = {NULL, 0};
  FILE* file = fopen(path, "rb");
  if (file == NULL) return bytes;
  fseek(file, 0, SEEK_END);
  bytes.size = (size_t)ftell(file);
  rewind(file);
  bytes.data = malloc(bytes.size);
  if (fread(bytes.data, 1, bytes.size, file) != bytes.size) bytes.size = 0;
  fclose(file);
  return bytes;
}

static int count_calls(const char* doing, void* user) {
  CHECK(doing != NULL && doing[0] != '\0', "nothing is being done");
  ++*(int*)user;
  return 0;
}

static int stop_at_once(const char* doing, void* user) {
  (void)doing;
  (void)user;
  return 1;
}

/* 30 frames of the motion's arrays. */
static void put_beginning(mimicx_motion* from, mimicx_motion* to) {
  const char* members[] = {"poses", "trans", "betas", "mocap_framerate"};
  for (int k = 0; k < 4; ++k) {
    mimicx_array array;
    CHECK(mimicx_motion_array(from, members[k], &array) == MIMICX_OK, "%s", mimicx_motion_error(from));
    if (k < 2) array.shape[0] = 30;
    CHECK(mimicx_motion_put(to, members[k], &array) == MIMICX_OK, "%s", mimicx_motion_error(to));
  }
  const char* model = "mimicx";
  CHECK(mimicx_motion_put_text(to, "body_model", &model, 1) == MIMICX_OK, "%s", mimicx_motion_error(to));
}

/* A setting that fails leaves the earlier one; one that is made after reading is of the next motion. */
static void check_later_settings(mimicx_motion* motion, const Bytes* file) {
  mimicx_array array;
  const char* box = "{\"plates\": [{\"centre\": [0, 9], \"half_extents\": [0.5, 0.5], \"height\": 0.3}]}";
  CHECK(mimicx_motion_set(motion, "scene", box) == MIMICX_OK, "%s", mimicx_motion_error(motion));
  CHECK(mimicx_motion_set(motion, "scene", "{\"plates\": [{}]}") == MIMICX_FAILED, "a plate without a place");
  CHECK(mimicx_motion_read(motion, file->data, file->size, "walk.npz") == MIMICX_OK, "%s",
        mimicx_motion_error(motion));
  CHECK(mimicx_motion_array(motion, "scene_plates", &array) == MIMICX_OK && array.shape[0] == 1,
        "the box is gone");
  const void* bytes;
  size_t size = 0;
  CHECK(mimicx_motion_write(motion, ".bvh", &bytes, &size) == MIMICX_OK, "%s", mimicx_motion_error(motion));
  const Bytes before = {malloc(size), size};
  memcpy(before.data, bytes, size);
  const char* audit = mimicx_motion_audit(motion);
  char* audit_before = strdup(audit != NULL ? audit : "");
  CHECK(audit_before[0] != '\0', "%s", mimicx_motion_error(motion));
  CHECK(mimicx_motion_set(motion, "scale", "0.5") == MIMICX_OK, "%s", mimicx_motion_error(motion));
  CHECK(mimicx_motion_write(motion, ".bvh", &bytes, &size) == MIMICX_OK && size == before.size &&
            memcmp(bytes, before.data, size) == 0,
        "the motion was read again with a later setting");
  audit = mimicx_motion_audit(motion);
  CHECK(audit != NULL && strcmp(audit, audit_before) == 0, "it was audited with a later setting");
  free(before.data);
  free(audit_before);
}

static void check_reading(const Bytes* file) {
  mimicx_motion* motion = mimicx_motion_new();
  mimicx_array array;
  CHECK(mimicx_motion_array(motion, "poses", &array) == MIMICX_FAILED, "there is no motion yet");
  CHECK(mimicx_motion_members(motion) == NULL && mimicx_motion_record(motion) == NULL,
        "there is no motion yet");
  CHECK(mimicx_motion_read(motion, "nonsense", 8, "clip.bvh") == MIMICX_FAILED, "nonsense was read");
  CHECK(strstr(mimicx_motion_error(motion), "clip.bvh") != NULL, "%s", mimicx_motion_error(motion));
  CHECK(mimicx_motion_read(motion, NULL, 8, "clip.bvh") == MIMICX_FAILED, "NULL was read");
  CHECK(mimicx_motion_read(NULL, "", 0, "clip.bvh") == MIMICX_FAILED, "without a handle");
  CHECK(mimicx_motion_read(motion, file->data, file->size, "walk.npz") == MIMICX_OK, "%s",
        mimicx_motion_error(motion));
  CHECK(mimicx_motion_array(motion, "poses", &array) == MIMICX_OK, "%s", mimicx_motion_error(motion));
  CHECK(array.dimensions == 2 && array.shape[1] == 66 && strcmp(array.type, "<f8") == 0, "another shape");
  const int64_t frames = array.shape[0];
  CHECK(mimicx_motion_read(motion, file->data, file->size / 2, "half.npz") == MIMICX_FAILED,
        "half a file was read");
  CHECK(mimicx_motion_array(motion, "trans", &array) == MIMICX_OK && array.shape[0] == frames,
        "the handle is as it was");
  CHECK(mimicx_motion_array(motion, "keypoint_names", &array) == MIMICX_FAILED, "texts are no numbers");
  CHECK(mimicx_motion_array(motion, "wings", &array) == MIMICX_FAILED, "no such member");
  CHECK(strstr(mimicx_motion_members(motion), "poses\n") != NULL, "%s", mimicx_motion_members(motion));
  CHECK(strstr(mimicx_motion_audit(motion), "poses alone") != NULL, "%s", mimicx_motion_error(motion));
  const void* bytes;
  size_t size;
  CHECK(mimicx_motion_write(motion, ".bvh", &bytes, &size) == MIMICX_OK && memcmp(bytes, "HIERARCHY", 9) == 0,
        "no BVH");
  CHECK(mimicx_motion_write(motion, ".doc", &bytes, &size) == MIMICX_FAILED, "no such format");
  CHECK(mimicx_motion_set(motion, "plan_horizon", "0") == MIMICX_FAILED, "an impossible setting");
  CHECK(strstr(mimicx_motion_error(motion), "plan_horizon") != NULL, "%s", mimicx_motion_error(motion));
  CHECK(mimicx_motion_set(motion, "colour", "1") == MIMICX_FAILED, "no such setting");
  CHECK(mimicx_motion_set(motion, "up", "w") == MIMICX_FAILED, "no such axis");
  CHECK(mimicx_motion_set(motion, "threads", "two") == MIMICX_FAILED, "no number");
  CHECK(mimicx_motion_set(motion, "limit_seconds", "-1") == MIMICX_FAILED, "a time below 0");
  CHECK(mimicx_motion_set(motion, "fps", "0") == MIMICX_FAILED, "no frame rate");
  CHECK(mimicx_motion_set(motion, "scene", "{\"plates\": [{}]}") == MIMICX_FAILED, "a plate without a place");
  CHECK(strstr(mimicx_motion_error(motion), "plate 1") != NULL, "%s", mimicx_motion_error(motion));
  check_later_settings(motion, file);
  mimicx_array no_array = {NULL, "<c8", 1, {1, 0, 0, 0}};
  CHECK(mimicx_motion_put(motion, "poses", &no_array) == MIMICX_FAILED, "no such type");
  mimicx_array huge = {&no_array, "<f8", 2, {INT64_C(1) << 40, INT64_C(1) << 40, 0, 0}};
  CHECK(mimicx_motion_put(motion, "poses", &huge) == MIMICX_FAILED, "a shape that no array has");
  mimicx_motion_free(motion);
  mimicx_motion_free(NULL);
}

/* The bytes are those of the program. */
static void check_cleaning(const Bytes* file, const char* program) {
  mimicx_motion *whole = mimicx_motion_new(), *motion = mimicx_motion_new();
  mimicx_motion_read(whole, file->data, file->size, "whole.npz");
  put_beginning(whole, motion);
  const void* bytes;
  size_t size = 0;
  CHECK(mimicx_motion_write(motion, ".npz", &bytes, &size) == MIMICX_OK, "%s", mimicx_motion_error(motion));
  char folder[] = "/tmp/mimicx-c.XXXXXX", command[2048], name[256];
  CHECK(mkdtemp(folder) != NULL, "no folder");
  snprintf(name, sizeof name, "%s/clip.npz", folder);
  FILE* clip = fopen(name, "wb");
  CHECK(clip != NULL && fwrite(bytes, 1, size, clip) == size && fclose(clip) == 0, "%s", name);
  CHECK(mimicx_motion_read(motion, bytes, size, "clip.npz") == MIMICX_OK, "%s", mimicx_motion_error(motion));
  mimicx_array before, after;
  mimicx_motion_array(motion, "poses", &before);
  CHECK(mimicx_motion_clean(motion, stop_at_once, NULL) == MIMICX_STOPPED, "it was not stopped");
  CHECK(mimicx_motion_record(motion) == NULL, "nothing was cleaned");
  int calls = 0;
  CHECK(mimicx_motion_clean(motion, count_calls, &calls) == MIMICX_OK, "%s", mimicx_motion_error(motion));
  CHECK(calls > 0, "nothing was told");
  CHECK(mimicx_motion_array(motion, "joint_torques", &after) == MIMICX_OK, "%s", mimicx_motion_error(motion));
  CHECK(after.shape[0] == before.shape[0] && after.shape[1] == 55, "another shape");
  CHECK(strstr(mimicx_motion_record(motion), "\"status\": \"ok\"") != NULL, "%s",
        mimicx_motion_record(motion));
  CHECK(strstr(mimicx_motion_audit(motion), "\"passed\": true") != NULL, "%s", mimicx_motion_error(motion));

  snprintf(command, sizeof command, "'%s' plan %s --out %s/run --quiet", program, name, folder);
  CHECK(system(command) == 0, "%s", command);
  snprintf(name, sizeof name, "%s/run/motions/clip.npz", folder);
  Bytes written = read_file(name);
  CHECK(mimicx_motion_write(motion, ".npz", &bytes, &size) == MIMICX_OK, "%s", mimicx_motion_error(motion));
  CHECK(size == written.size && memcmp(bytes, written.data, size) == 0, "other bytes than mimicx plan");
  free(written.data);
  CHECK(mimicx_motion_write(motion, ".glb", &bytes, &size) == MIMICX_OK && memcmp(bytes, "glTF", 4) == 0,
        "no glTF");
  snprintf(command, sizeof command, "rm -r %s", folder);
  CHECK(system(command) == 0, "%s", command);
  mimicx_motion_free(whole);
  mimicx_motion_free(motion);
}

typedef struct {
  const Bytes* file;
  Bytes written;
} Worker;

static void* clean_beginning(void* argument) {
  Worker* worker = argument;
  mimicx_motion *whole = mimicx_motion_new(), *motion = mimicx_motion_new();
  mimicx_motion_read(whole, worker->file->data, worker->file->size, "whole.npz");
  put_beginning(whole, motion);
  mimicx_motion_set(motion, "threads", "1");
  CHECK(mimicx_motion_clean(motion, NULL, NULL) == MIMICX_OK, "%s", mimicx_motion_error(motion));
  const void* bytes;
  size_t size = 0;
  mimicx_motion_write(motion, ".npz", &bytes, &size);
  worker->written.size = size;
  worker->written.data = malloc(size);
  memcpy(worker->written.data, bytes, size);
  mimicx_motion_free(whole);
  mimicx_motion_free(motion);
  return NULL;
}

static void check_threads(const Bytes* file) {
  Worker workers[2] = {{file, {NULL, 0}}, {file, {NULL, 0}}};
  pthread_t threads[2];
  for (int k = 0; k < 2; ++k) pthread_create(&threads[k], NULL, clean_beginning, &workers[k]);
  for (int k = 0; k < 2; ++k) pthread_join(threads[k], NULL);
  CHECK(workers[0].written.size > 0 && workers[0].written.size == workers[1].written.size &&
            memcmp(workers[0].written.data, workers[1].written.data, workers[0].written.size) == 0,
        "two threads, two results");
  for (int k = 0; k < 2; ++k) free(workers[k].written.data);
}

static double* numbers(mimicx_simulator* simulator, const char* name) {
  mimicx_array array = {NULL, "", 0, {0, 0, 0, 0}};
  CHECK(mimicx_simulator_array(simulator, name, &array) == MIMICX_OK, "%s",
        mimicx_simulator_error(simulator));
  return array.data;
}

static void check_simulator(void) {
  mimicx_simulator* simulator = mimicx_simulator_new(NULL);
  double *place = numbers(simulator, "root_position"), *ground = numbers(simulator, "ground_wrenches"),
         *push = numbers(simulator, "push"), *target = numbers(simulator, "target_rotations");
  const double height = place[2];
  double weight = 0.0, after_a_tenth;
  CHECK(mimicx_simulator_step(simulator, 24) == MIMICX_OK, "%s", mimicx_simulator_error(simulator));
  after_a_tenth = place[2];
  CHECK(fabs(after_a_tenth - height) < 0.02, "it fell from %g to %g m", height, after_a_tenth);
  for (int body = 0; body < MIMICX_BODIES; ++body) weight += ground[6 * body + 5];
  CHECK(weight > 300.0 && weight < 1200.0, "the floor carries %g N", weight);
  push[3] = 200.0;
  const double x = place[0];
  CHECK(mimicx_simulator_step(simulator, 24) == MIMICX_OK, "%s", mimicx_simulator_error(simulator));
  CHECK(place[0] - x > 0.005, "a push moved it by %g m", place[0] - x);
  CHECK(mimicx_simulator_stand(simulator) == MIMICX_OK && place[2] == height && push[3] == 0.0,
        "it does not stand again");
  target[4 * 4] = 0.0;
  CHECK(mimicx_simulator_step(simulator, 1) == MIMICX_FAILED, "no rotation is no target");
  CHECK(strstr(mimicx_simulator_error(simulator), "left_knee") != NULL, "%s",
        mimicx_simulator_error(simulator));
  mimicx_simulator_stand(simulator);
  place[0] = NAN;
  CHECK(mimicx_simulator_step(simulator, 1) == MIMICX_FAILED, "NaN is no place");
  mimicx_simulator_stand(simulator);
  CHECK(mimicx_simulator_set(simulator, "gravity", 1.62) == MIMICX_OK, "%s",
        mimicx_simulator_error(simulator));
  CHECK(mimicx_simulator_set(simulator, "gravity", 0.0) == MIMICX_FAILED, "no weight");
  CHECK(mimicx_simulator_set(simulator, "friction", -1.0) == MIMICX_FAILED, "an impossible setting");
  CHECK(mimicx_simulator_set(simulator, "colour", 1.0) == MIMICX_FAILED, "no such setting");
  mimicx_array array;
  CHECK(mimicx_simulator_array(simulator, "wings", &array) == MIMICX_FAILED, "no such array");
  mimicx_simulator_free(simulator);
  mimicx_simulator_free(NULL);
  const double no_shape[10] = {NAN};
  CHECK(mimicx_simulator_new(no_shape) == NULL, "NaN is no shape");
}

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const Bytes file = read_file(argv[2]);
  CHECK(file.size > 0, "%s cannot be read", argv[2]);
  CHECK(mimicx_abi() == MIMICX_ABI, "another header");
  CHECK(strcmp(mimicx_body_name(4), "left_knee") == 0 && mimicx_body_parent(4) == 1, "%s",
        mimicx_body_name(4));
  CHECK(mimicx_body_name(22) == NULL && mimicx_body_parent(0) == -1, "there are 22 bodies");
  printf("mimicx %s\n", mimicx_version());
  check_reading(&file);
  check_cleaning(&file, argv[1]);
  check_threads(&file);
  check_simulator();
  free(file.data);
  if (problems == 0) printf("the C interface: all as expected\n");
  return problems == 0 ? 0 : 1;
}
