/// What the program does when it is interrupted (Ctrl-C) or told to end.
#pragma once

namespace mimicx::tools {

/// Sets the handlers of signals: a closed pipe or a limit of file sizes is an error of writing, which is
/// reported; an interrupt ends the program and leaves no temporary file.
void handle_signals();

/// From now on the first interrupt asks for a checkpoint, and a second one ends the program at once.
void catch_interrupts();

/// Whether there was an interrupt since `catch_interrupts`.
bool interrupted();

}  // namespace mimicx::tools
