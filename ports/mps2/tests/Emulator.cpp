#include "ports/mps2/tests/Emulator.hpp"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <system_error>
#include <thread>

#include "ports/mps2/registers.hpp"

namespace wr::mps2 {
namespace {

constexpr int kPatience = 20'000;  // [ms] after this real time without an answer, a test fails
constexpr char kMessages[] = "messages";
constexpr char kProgram[] = "qemu-system-arm";

// Tries to connect to a socket until QEMU listens at this socket.
std::unique_ptr<UnixLine> connectTo(const std::filesystem::path& socket) {
  for (int tried = 0;; ++tried) {
    try {
      return std::make_unique<UnixLine>(socket.string());
    } catch (const std::system_error&) {
      if (tried == kPatience / 10) {
        throw;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
  }
}

std::filesystem::path newFolder() {
  std::string path = (std::filesystem::temp_directory_path() / "mps2-XXXXXX").string();
  if (::mkdtemp(path.data()) == nullptr) {
    throw std::runtime_error("the temporary folder " + path + " cannot be created");
  }
  return path;
}

// Starts QEMU, which writes its error messages to a file.
pid_t start(std::vector<std::string> words, const std::filesystem::path& messages) {
  std::vector<char*> arguments;
  for (std::string& word : words) {
    arguments.push_back(word.data());
  }
  arguments.push_back(nullptr);
  pid_t process = 0;
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, messages.c_str(), O_WRONLY | O_CREAT,
                                     S_IRUSR | S_IWUSR);
  const int error =
      ::posix_spawnp(&process, kProgram, &actions, nullptr, arguments.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  if (error != 0) {
    throw std::system_error(error, std::generic_category(), kProgram);
  }
  return process;
}

std::string hex(std::uint32_t value) {
  std::array<char, 9> text{};
  std::snprintf(text.data(), text.size(), "%x", value);
  return text.data();
}

// Converts the hexadecimal digits of a little-endian word to its value.
std::uint32_t wordOf(const std::string& digits) {
  if (digits.size() != 8) {
    throw std::runtime_error("QEMU does not answer with 8 hexadecimal digits, but with: " + digits);
  }
  return __builtin_bswap32(static_cast<std::uint32_t>(std::stoul(digits, nullptr, 16)));
}

}  // namespace

Emulator::Emulator(const std::filesystem::path& elf) : folder_(newFolder()) {
  const auto socket = [this](const std::string& name) {
    return "socket,id=" + name + ",server=on,wait=off,path=" + (folder_ / name).string();
  };
  // Each instruction takes 128 ns of emulated time. This is about three clock cycles of the board
  // (40 ns each). With a shorter time, QEMU would execute more instructions in a control cycle, and
  // the tests would last longer.
  process_ = start({kProgram,      "-M",           "mps2-an386",  "-display",     "none",
                    "-monitor",    "none",         "-icount",     "shift=7",      "-S",
                    "-chardev",    socket("line"), "-serial",     "chardev:line", "-chardev",
                    socket("gdb"), "-gdb",         "chardev:gdb", "-kernel",      elf.string()},
                   folder_ / kMessages);
  serial_ = connectTo(folder_ / "line");
  control_ = connectTo(folder_ / "gdb");
  packets_ = std::make_unique<gdb::PacketStream>(*control_);
  static_cast<void>(ask("?"));
}

Emulator::~Emulator() {
  ::kill(process_, SIGKILL);
  ::waitpid(process_, nullptr, 0);
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

std::uint32_t Emulator::runTo(std::initializer_list<std::uint32_t> places) {
  for (const std::uint32_t place : places) {
    static_cast<void>(ask("Z1," + hex(place) + ",2"));
  }
  static_cast<void>(ask("c"));
  for (const std::uint32_t place : places) {
    static_cast<void>(ask("z1," + hex(place) + ",2"));
  }
  constexpr std::size_t kProgramCounter = 15;  // index of the register; each register has 8 digits
  return wordOf(ask("g").substr(8 * kProgramCounter, 8));
}

void Emulator::send(std::span<const std::uint8_t> bytes, std::uint32_t rest) {
  for (const std::uint8_t byte : bytes) {
    static_cast<void>(serial_->write({&byte, 1}));
    const auto begin = std::chrono::steady_clock::now();
    // register STATE of the serial port
    while ((word(0x40004004) & uart::STATE_RX_FULL.value) == 0) {
      if (std::chrono::steady_clock::now() - begin > std::chrono::milliseconds(kPatience)) {
        throw std::runtime_error("the serial port of the emulated board does not accept a byte");
      }
    }
    // The program is at rest again when it has served the interrupt of this byte.
    static_cast<void>(runTo({rest}));
  }
}

void Emulator::replaceByNothing(std::uint32_t place) {
  static_cast<void>(ask("M" + hex(place) + ",2:00bf"));
}

std::uint32_t Emulator::word(std::uint32_t address) {
  return wordOf(ask("m" + hex(address) + ",4"));
}

std::vector<std::uint8_t> Emulator::takeSent() {
  std::vector<std::uint8_t> sent;
  std::array<std::uint8_t, 1024> part{};
  for (std::size_t count = serial_->read(part); count != 0; count = serial_->read(part)) {
    sent.insert(sent.end(), part.begin(), part.begin() + static_cast<std::ptrdiff_t>(count));
  }
  return sent;
}

std::string Emulator::ask(std::string_view command) {
  packets_->send(command);
  return answer();
}

std::string Emulator::answer() {
  for (;;) {
    if (auto packet = packets_->take()) {
      return *packet;
    }
    if (!control_->wait(kPatience)) {
      std::ifstream messages(folder_ / kMessages);
      throw std::runtime_error("QEMU does not answer: " +
                               std::string(std::istreambuf_iterator(messages), {}));
    }
  }
}

}  // namespace wr::mps2
