// Signals at any moment, on a slow disk: every output is whole or absent, and the program says that
// it was cancelled.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "core/io/json.hpp"
#include "core/io/result.hpp"
#include "core/io/result_reader.hpp"
#include "core/io/scene_reader.hpp"
#include "tests/app/program.hpp"

namespace substep {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

fs::path empty_folder() {
  const fs::path at = folder() / "files";
  fs::remove_all(at);
  fs::create_directories(at);
  return at;
}

/// A running program in a folder, with a slow fsync. Its streams go to files beside the folder.
class Running {
 public:
  Running(const fs::path& at, std::vector<std::string> arguments, int fsync_ms,
          int ignored_signal = 0)
      : at_(at) {
    pid_ = ::fork();
    if (pid_ == 0) become(arguments, fsync_ms, ignored_signal);
  }
  ~Running() {
    if (ended_) return;
    send(SIGKILL);
    wait();
  }
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;

  void send(int signal) const { ::kill(pid_, signal); }
  [[nodiscard]] bool has_ended() {
    if (!ended_) ended_ = ::waitpid(pid_, &status_, WNOHANG) == pid_;
    return ended_;
  }
  /// @return the exit code as the shells give it: 128 + signal if a signal ended it
  int wait() {
    constexpr std::chrono::seconds kMostTime{60};
    const auto begin = Clock::now();
    while (!has_ended()) {
      if (Clock::now() - begin > kMostTime) {
        ADD_FAILURE() << "it does not end";
        send(SIGKILL);
      }
      std::this_thread::sleep_for(milliseconds(1));
    }
    return WIFEXITED(status_) ? WEXITSTATUS(status_) : 128 + WTERMSIG(status_);
  }
  /// Waits until a file of that name exists, or the program ends.
  void wait_for(const std::string& beginning) {
    while (!has_ended()) {
      for (const auto& entry : fs::directory_iterator(at_)) {
        if (entry.path().filename().string().starts_with(beginning)) return;
      }
      std::this_thread::sleep_for(milliseconds(1));
    }
  }
  /// Whether the program catches the signal yet.
  [[nodiscard]] bool catches(int signal) const {
    std::ifstream status("/proc/" + std::to_string(pid_) + "/status");
    for (std::string line; std::getline(status, line);) {
      if (!line.starts_with("SigCgt:")) continue;
      return ((std::stoull(line.substr(7), nullptr, 16) >> (signal - 1)) & 1U) != 0U;
    }
    return false;
  }
  /// Waits until it does, or ends.
  void wait_until_it_catches(int signal) {
    while (!catches(signal) && !has_ended()) std::this_thread::sleep_for(milliseconds(1));
  }
  [[nodiscard]] std::string err() const { return text_of(at_.string() + ".err"); }

 private:
  [[noreturn]] void become(const std::vector<std::string>& arguments, int fsync_ms,
                           int ignored_signal) const {
    const auto place = [](int stream, const std::string& path, int flags) {
      const int file = ::open(path.c_str(), flags | O_CREAT, 0666);
      ::dup2(file, stream);
    };
    place(STDIN_FILENO, "/dev/null", O_RDONLY);
    place(STDOUT_FILENO, at_.string() + ".out", O_WRONLY | O_TRUNC);
    place(STDERR_FILENO, at_.string() + ".err", O_WRONLY | O_TRUNC);
    if (::chdir(at_.c_str()) != 0) std::_Exit(126);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, SIG_DFL);
    if (ignored_signal != 0) std::signal(ignored_signal, SIG_IGN);
    ::setenv("LD_PRELOAD", SUBSTEP_SLOW_FSYNC, 1);
    ::setenv("SUBSTEP_FSYNC_MS", std::to_string(fsync_ms).c_str(), 1);
    const char* options = std::getenv("ASAN_OPTIONS");  // its library is not the first
    ::setenv("ASAN_OPTIONS",
             (std::string(options ? options : "") + ":verify_asan_link_order=0").c_str(), 1);
    std::string program = SUBSTEP_PROGRAM;
    std::vector<char*> words{program.data()};
    for (const std::string& argument : arguments)
      words.push_back(const_cast<char*>(argument.c_str()));
    words.push_back(nullptr);
    ::execv(program.c_str(), words.data());
    std::_Exit(126);
  }

  fs::path at_;
  pid_t pid_ = -1;
  bool ended_ = false;
  int status_ = 0;
};

bool is_temporary(const std::string& name) { return name.ends_with(".new"); }

/// Every file of the folder is whole. @param cut whether a results file may end in a cut line
void expect_whole(const fs::path& at, bool cut, const std::string& what) {
  for (const auto& entry : fs::recursive_directory_iterator(at)) {
    const std::string name = entry.path().filename().string();
    if (entry.is_directory() || is_temporary(name)) continue;
    const std::string text = text_of(entry.path());
    if (name.ends_with(".jsonl")) {
      // The name exists from the beginning: at least the header is there, or nothing yet.
      EXPECT_TRUE(cut || text.empty() || text.back() == '\n') << what;
      std::vector<std::string> lines = lines_of(text);
      if (cut && !text.empty() && text.back() != '\n') lines.pop_back();
      for (std::size_t i = 0; i < lines.size(); ++i) {
        Problems problems;
        const Json json = Json::parse(lines[i], nullptr, false);
        i == 0 ? check_results_header(lines[i], problems) : void(read_result(json, problems));
        EXPECT_TRUE(problems.empty()) << what << ": " << name << ": " << lines[i];
      }
    } else if (name == "scene.json") {
      EXPECT_TRUE(read_scene_file(entry.path().string()).scene) << what;
    } else if (name.ends_with(".json")) {
      EXPECT_TRUE(Json::parse(text, nullptr, false).is_object()) << what << ": " << name;
    } else if (name.ends_with(".html")) {
      EXPECT_EQ(text.rfind("</html>\n"), text.size() - 8) << what;
    } else {
      ASSERT_TRUE(name.ends_with(".csv")) << name;
      const std::vector<std::string> lines = lines_of(text);
      ASSERT_FALSE(lines.empty()) << what;
      EXPECT_EQ(text.back(), '\n') << what;
      const auto commas = [](const std::string& line) {
        return std::count(line.begin(), line.end(), ',');
      };
      EXPECT_EQ(commas(lines.back()), commas(lines.front())) << what << ": " << name;
    }
  }
}

std::size_t temporaries_in(const fs::path& at) {
  std::size_t count = 0;
  for (const auto& entry : fs::recursive_directory_iterator(at)) {
    if (is_temporary(entry.path().filename().string())) ++count;
  }
  return count;
}

int rounds() {
  const char* text = std::getenv("SUBSTEP_SIGNALS");
  return text != nullptr ? std::atoi(text) : 24;
}

TEST(Signals, AtAnyMomentEveryOutputIsWholeOrAbsent) {
  constexpr int kFsync = 250;  // [ms], beyond the patience of the program
  const std::vector<std::vector<std::string>> commands = {
      {"sweep", "free_fall", "--seconds", "0.1", "--out", "s"},
      {"run", "pendulum", "--seconds", "20", "--csv", "a.csv", "--json", "a.json", "--states",
       "b.csv", "--joints", "c.csv", "--quiet"}};
  std::mt19937 random(static_cast<unsigned>(rounds()));
  std::uniform_int_distribution<int> later(0, 1500);  // [ms], beyond the ends of most
  int ended = 0;
  int complete = 0;
  int early = 0;  // before the program had begun
  int killed = 0;
  int kept = 0;  // files in the folders of ended programs
  for (int round = 0; round < rounds(); ++round) {
    const fs::path at = empty_folder();
    const std::vector<std::string>& command = commands[static_cast<std::size_t>(round % 2)];
    const int signal =
        std::vector{SIGINT, SIGTERM, SIGHUP, SIGKILL}[static_cast<std::size_t>(round / 2 % 4)];
    if (round % 16 >= 8) std::ofstream(at / "a.json") << "{\"old\": 1}";  // replaced or kept
    const int after = later(random);
    const std::string what = command[0] + ", signal " + std::to_string(signal) + " after " +
                             std::to_string(after) + " ms, round " + std::to_string(round);
    Running program(at, command, kFsync);
    const auto until = Clock::now() + milliseconds(after);
    while (Clock::now() < until && !program.has_ended()) {
      std::this_thread::sleep_for(milliseconds(1));
    }
    const bool catches = program.catches(signal);
    program.send(signal);
    const int code = program.wait();
    const bool is_kill = signal == SIGKILL;
    expect_whole(at, is_kill, what);
    if (code == 0) {
      ++complete;
    } else if (is_kill) {
      ++killed;
    } else {
      EXPECT_EQ(code, 128 + signal) << what << program.err();
      const bool begun = !program.err().empty();
      EXPECT_TRUE(begun ? program.err().find("cancelled") != std::string::npos : !catches)
          << what << program.err();
      begun ? ++ended : ++early;
      kept += static_cast<int>(std::distance(fs::directory_iterator(at), {}));
    }
    EXPECT_TRUE(is_kill || temporaries_in(at) == 0U) << what;
  }
  std::printf(
      "%d rounds: %d ended by INT, TERM or HUP with %d files, %d by KILL, %d complete, %d "
      "signalled before they began\n",
      rounds(), ended, kept, killed, complete, early);
  EXPECT_GT(ended, 0);
}

TEST(Signals, AnOutputThatIsBeingCommittedIsCompleted) {
  for (const int signals : {1, 2}) {
    const fs::path at = empty_folder();
    Running program(at, {"run", "pendulum", "--frames", "60", "--csv", "a.csv", "--json", "a.json"},
                    1000);
    program.wait_for("a.json.");
    std::this_thread::sleep_for(milliseconds(500));  // it commits the first
    for (int i = 0; i < signals; ++i) {
      program.send(SIGINT);
      std::this_thread::sleep_for(milliseconds(20));
    }
    EXPECT_EQ(program.wait(), 130);
    EXPECT_NE(program.err().find("cancelled"), std::string::npos);
    EXPECT_EQ(lines_of(text_of(at / "a.csv")).size(), 61U);
    const Json json = Json::parse(text_of(at / "a.json"), nullptr, false);
    ASSERT_TRUE(json.is_object()) << text_of(at / "a.json").substr(0, 100);
    EXPECT_EQ(json["frames"].size(), 60U);
    EXPECT_TRUE(json.contains("verdict")) << "it was complete";
    EXPECT_EQ(temporaries_in(at), 0U);
  }
}

TEST(Signals, ManyInQuickSuccessionLeaveNoTemporaryFile) {
  for (const int fsync_ms : {0, 300, 5000}) {
    for (const int signals : {3, 5, 40}) {
      const fs::path at = empty_folder();
      std::ofstream(at / "a.json") << "{\"old\": 1}";
      const std::string what =
          std::to_string(signals) + " signals, fsync " + std::to_string(fsync_ms) + " ms";
      Running program(at,
                      {"run", "pendulum", "--frames", "60", "--csv", "a.csv", "--json", "a.json"},
                      fsync_ms);
      program.wait_for("a.json.");
      if (fsync_ms > 0) std::this_thread::sleep_for(milliseconds(200));  // it commits the first
      for (int i = 0; i < signals; ++i) {
        program.send(SIGTERM);
        std::this_thread::sleep_for(milliseconds(5));  // pending ones are merged
      }
      const int code = program.wait();
      EXPECT_TRUE(code == 143 || (code == 0 && fsync_ms == 0)) << what << ": " << code;
      if (code != 0) {
        EXPECT_NE(program.err().find("cancelled"), std::string::npos) << what;
      }
      EXPECT_EQ(temporaries_in(at), 0U) << what;
      expect_whole(at, false, what);
      EXPECT_TRUE(fs::exists(at / "a.csv") || fsync_ms != 300) << what << ": there was time";
    }
  }
}

TEST(Signals, EveryEndedCommandSaysSo) {
  const std::vector<std::vector<std::string>> commands = {
      {"recommend", "bridge"},  {"sweep", "bridge", "--ship", "s.txt"},
      {"check", "--hard"},      {"hash", "bridge", "--seconds", "80000"},
      {"reproduce", "--quiet"}, {"merge", "folder", "pipe"}};
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    for (const std::vector<std::string>& command : commands) {
      const fs::path at = empty_folder();
      ASSERT_EQ(::mkfifo((at / "pipe").c_str(), 0666), 0);  // merge waits for it
      Running program(at, command, 0);
      program.wait_until_it_catches(signal);
      std::this_thread::sleep_for(milliseconds(200));  // it is at work
      program.send(signal);
      EXPECT_EQ(program.wait(), 128 + signal) << command[0];
      EXPECT_NE(program.err().find("cancelled"), std::string::npos) << command[0];
      EXPECT_EQ(program.err().find("cancelled"), program.err().rfind("cancelled")) << "said once";
      EXPECT_EQ(temporaries_in(at), 0U);
      EXPECT_FALSE(fs::exists(at / "s.txt"));
    }
  }
}

TEST(Signals, ThoseThatWereIgnoredStayIgnored) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const fs::path at = empty_folder();
    Running program(at, {"run", "pendulum", "--seconds", "80000", "--csv", "a.csv"}, 0, signal);
    program.wait_for("a.csv.");
    program.send(signal);
    std::this_thread::sleep_for(milliseconds(300));
    EXPECT_FALSE(program.has_ended());
    const int other = signal == SIGTERM ? SIGINT : SIGTERM;
    program.send(other);
    EXPECT_EQ(program.wait(), 128 + other);
  }
}

}  // namespace
}  // namespace substep
