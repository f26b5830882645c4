// From reset to main on a Cortex-M7, and what counts there. Output goes through semihosting (rdimon of
// newlib).
//
// Counting: SysTick runs down at the processor's clock. Under the emulator's `-icount shift=0` an instruction
// takes exactly a nanosecond of its time, so a tick is a constant number of instructions (40 at 25 MHz),
// which a loop of known length measures first.
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "core/error.h"
#include "machine.h"

namespace {

constexpr std::uint32_t kTicks = 0x00ffffff;
constexpr std::uint32_t kPaint = 0xa5a5a5a5;

volatile std::uint32_t& reg(std::uintptr_t address) {
  return *reinterpret_cast<volatile std::uint32_t*>(address);
}
volatile std::uint32_t& systick_control() { return reg(0xe000e010); }
volatile std::uint32_t& systick_reload() { return reg(0xe000e014); }
volatile std::uint32_t& systick_now() { return reg(0xe000e018); }
volatile std::uint32_t& coprocessor_access() { return reg(0xe000ed88); }

std::uint32_t heap_used = 0, heap_most = 0;

double instructions_per_tick() {
  constexpr std::uint32_t kRounds = 1000000;
  std::uint32_t left = kRounds;
  const std::uint32_t began = systick_now();
  asm volatile("1: subs %0, #1\n bne 1b" : "+r"(left) : : "cc");
  return 2.0 * kRounds / ((began - systick_now()) & kTicks);
}

}  // namespace

extern "C" {

// Of the linker script (cortex_m7.ld).
extern std::uint32_t data_begin, data_end, data_load, bss_begin, bss_end, stack_begin, stack_end, heap_begin,
    heap_end;
extern void (*init_begin[])();
extern void (*init_end[])();
void initialise_monitor_handles();
int main();

/// The most that there was of each, bytes.
void print_memory() {
  const std::uint32_t* deepest = &stack_begin;
  while (*deepest == kPaint) ++deepest;
  const auto stack = reinterpret_cast<std::uintptr_t>(&stack_end) - reinterpret_cast<std::uintptr_t>(deepest);
  std::printf("counted: stack %lu heap %lu\n", static_cast<unsigned long>(stack),
              static_cast<unsigned long>(heap_most));
}

[[noreturn]] void reset() {
  coprocessor_access() |= 0xfu << 20;  // the floating-point unit, before anything uses it
  asm volatile("dsb\n isb" ::: "memory");
  for (std::uint32_t *to = &data_begin, *from = &data_load; to != &data_end;) *to++ = *from++;
  for (std::uint32_t* to = &bss_begin; to != &bss_end;) *to++ = 0;
  const auto here = reinterpret_cast<std::uint32_t*>(__builtin_frame_address(0)) - 64;
  for (std::uint32_t* to = &stack_begin; to < here;) *to++ = kPaint;
  systick_reload() = kTicks;
  systick_now() = 0;
  systick_control() = 5;  // on, by the processor's clock, no interrupt
  initialise_monitor_handles();
  for (auto init = init_begin; init != init_end; ++init) (*init)();
  const int status = main();
  print_memory();
  std::exit(status);
}

[[noreturn]] void fault() {
  std::printf("fault\n");
  std::exit(2);
}

[[gnu::section(".vectors"), gnu::used]] const void* const vectors[16] = {
    &stack_end,
    reinterpret_cast<const void*>(reset),
    reinterpret_cast<const void*>(fault),
    reinterpret_cast<const void*>(fault),
    reinterpret_cast<const void*>(fault),
    reinterpret_cast<const void*>(fault),
    reinterpret_cast<const void*>(fault)};

void* __dso_handle = nullptr;
void _init() {}
void _fini() {}

/// The heap of newlib.
void* _sbrk(int more) {
  char* const at = reinterpret_cast<char*>(&heap_begin) + heap_used;
  if (at + more > reinterpret_cast<char*>(&heap_end)) return reinterpret_cast<void*>(-1);
  heap_used += static_cast<std::uint32_t>(more);
  heap_most = heap_used > heap_most ? heap_used : heap_most;  // what is freed comes back
  return at;
}

}  // extern "C"

void Counted::begin() { began_ = systick_now(); }

void Counted::end() {
  const double ticks = (began_ - systick_now()) & kTicks;
  total_ += ticks;
  most_ = ticks > most_ ? ticks : most_;
  ++times_;
}

void print_counts(const Counted& thinking, const Counted& moving, int substeps) {
  const double each = instructions_per_tick();
  std::printf("counted: a tick is %.3f instructions\n", each);
  std::printf("counted: policy_step %.0f most %.0f\n", each * thinking.mean(), each * thinking.most());
  std::printf("counted: physics_step %.0f most %.0f\n", each * moving.mean() / substeps,
              each * moving.most() / substeps);
  std::printf("counted: frame %.0f\n", each * (thinking.mean() + moving.mean()));
}

// Of the standard library's errors there remain their names; nothing is thrown and nothing unwound.
namespace __gnu_cxx {
void __verbose_terminate_handler() { mimicx::stop("terminated"); }
}  // namespace __gnu_cxx

void* operator new(std::size_t size) {
  if (void* at = std::malloc(size)) return at;
  mimicx::stop("no memory");
}
void operator delete(void* at) noexcept { std::free(at); }
void operator delete(void* at, std::size_t) noexcept { std::free(at); }
