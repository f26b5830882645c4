// Functions that the page's worker calls. A call writes its answer into one buffer, as JSON or bytes; a call
// that fails writes {"error": "the program's message"}.
#include <memory>
#include <sstream>
#include <string>

#include "mimicx.h"
#include "page/played_frame_json.h"
#include "page/session.h"
#include "record/json.h"

// Functions that are used from outside stay in the program, and JavaScript sees them.
#define MIMICX_ASKED extern "C" __attribute__((used))

/// Defined in web/tell.js. @param urgent  0: progress; else a message that stays visible
extern "C" void mimicx_tell(const char* line, int urgent);

namespace {

using mimicx::page::Controller;
using mimicx::page::Playground;
using mimicx::page::Session;
using mimicx::record::Json;

/// The text that a terminal would show, with carriage returns applied.
std::string last_state(std::string text) {
  text.erase(0, text.rfind('\r') + 1);
  for (std::size_t at; (at = text.find("\x1b[K")) != std::string::npos;) text.erase(at, 3);
  return text;
}

/// Passes on what is written: whole lines, and progress, which has no end of line.
class Lines : public std::stringbuf {
 public:
  int sync() override {
    std::istringstream text(str());
    str("");
    for (std::string piece; std::getline(text, piece);) {
      const std::string line = last_state(piece);
      if (!line.empty()) mimicx_tell(line.c_str(), text.eof() ? 0 : 1);
    }
    return 0;
  }
};

Session& session() {
  static Session the_session("/cleaned");
  return the_session;
}
std::unique_ptr<Playground> playground;
std::string answer;

/// Stores the result of `work`, or its error, in the answer.
template <class Work>
void call(const Work& work) {
  try {
    answer = work();
  } catch (const std::exception& error) {
    answer = Json{{"error", error.what()}}.dump();
  }
}

/// @throws std::invalid_argument where nothing is being played
Playground& playing() {
  if (playground == nullptr) throw std::invalid_argument("the program was restarted: start to play again");
  return *playground;
}

std::string played() {
  const std::string body = session().body_of(playing().character());
  return played_json(playing(), body);
}

/// The current β, each with the name of what it changes.
Json betas() {
  Json list = Json::array();
  for (int k = 0; k < mimicx::kBetas; ++k)
    list.push_back({{"name", mimicx::name_of_beta(k)},
                    {"value", playing().character().betas[static_cast<std::size_t>(k)]}});
  return list;
}

}  // namespace

MIMICX_ASKED const char* mimicx_answer() { return answer.data(); }
MIMICX_ASKED int mimicx_answer_size() { return static_cast<int>(answer.size()); }

MIMICX_ASKED void mimicx_empty_report() { call(mimicx::page::empty_report); }

/// @param file  in the file system of this program
MIMICX_ASKED void mimicx_plan(const char* file) {
  call([&] {
    Lines lines;
    std::ostream out(&lines);
    mimicx::record::Progress progress(out, true, mimicx::record::steady_seconds);
    return session().plan(file, {progress, out, [] { return false; }});
  });
}

/// mimicx_motion_clean, which tells what is being done.
MIMICX_ASKED int mimicx_clean(mimicx_motion* motion) {
  const mimicx_progress tell = [](const char* doing, void*) {
    mimicx_tell(doing, 0);
    return 0;
  };
  return mimicx_motion_clean(motion, tell, nullptr);
}

/// @param file  as given to `mimicx_plan`; its run has been put back in place
MIMICX_ASKED void mimicx_take_up(const char* file) {
  call([&] { return session().take_up(file); });
}

MIMICX_ASKED int mimicx_saved(int number, const char* suffix) {
  bool good = false;
  call([&] {
    std::string bytes = session().saved(number, suffix);
    good = true;
    return bytes;
  });
  return good ? 1 : 0;
}

MIMICX_ASKED void mimicx_play(int number) {
  call([&] {
    playground = std::make_unique<Playground>(session().play(number));
    return Json{{"played", Json::parse(played())},
                {"bodies", Json::parse(session().bodies_json())},
                {"betas", betas()}}
        .dump();
  });
}

MIMICX_ASKED void mimicx_step() {
  call([] {
    playing().step();
    return played();
  });
}
MIMICX_ASKED void mimicx_restart() {
  call([] {
    playing().restart();
    return played();
  });
}
MIMICX_ASKED void mimicx_push(double x, double y, double z) {
  call([&] {
    playing().push({x, y, z});
    return std::string("{}");
  });
}
/// @param controller  0 feedback, 1 plan without feedback, 2 no motors
MIMICX_ASKED void mimicx_controller(int controller) {
  call([&] {
    playing().set_controller(static_cast<Controller>(controller));
    return std::string("{}");
  });
}
MIMICX_ASKED void mimicx_friction(double friction) {
  call([&] {
    playing().set_friction(friction);
    return std::string("{}");
  });
}
/// @param betas  [10], or null for the motion's own
MIMICX_ASKED void mimicx_shape(const double* betas) {
  call([&] {
    if (betas == nullptr) {
      playing().set_own_shape();
    } else {
      std::array<double, mimicx::kBetas> shape{};
      std::copy(betas, betas + mimicx::kBetas, shape.begin());
      playing().set_shape(shape);
    }
    return Json{{"played", Json::parse(played())}, {"bodies", Json::parse(session().bodies_json())}}.dump();
  });
}
