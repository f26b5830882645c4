#include "machine.h"

void Counted::begin() {}
void Counted::end() {}
void print_counts(const Counted&, const Counted&, int) {}
