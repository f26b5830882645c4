// The function that the program calls to report progress (src/page/page.cpp), for emscripten's linker.
mergeInto(LibraryManager.library, {
  mimicx_tell: function(line, urgent) { mimicx_told(UTF8ToString(line), urgent !== 0); },
});
