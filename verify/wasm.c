/* verify as WebAssembly, without a system: what a page calls. tools/verify_wasm builds it. */
#include "verify.h"

#define EXPORT(name) __attribute__((export_name(#name)))

static Rule rules[RULES];
static const char *wrong;

/* Room for a file behind everything else, or NULL. */
EXPORT(room) unsigned char *room(size_t bytes) {
  size_t pages = __builtin_wasm_memory_grow(0, bytes / 65536 + 1);
  return pages == (size_t)-1 ? NULL : (unsigned char *)(pages * 65536);
}

/* ACCEPTED, REJECTED or BROKEN. A motion of no bytes: there is none. */
EXPORT(verify) int verify(const unsigned char *file, size_t size, const unsigned char *motion, size_t motion_size) {
  return verify_bytes(file, size, motion_size ? motion : NULL, motion_size, rules, &wrong);
}

/* Rule `i` from 0, or NULL behind the last. */
EXPORT(rule) const Rule *rule(int i) { return i < RULES ? &rules[i] : NULL; }

/* What is wrong with a broken file. */
EXPORT(reason) const char *reason(void) { return wrong; }
