// A child process (the keeper) takes namespaces of its own for users, files, processes and the network,
// builds a root folder of what may be read, and starts the program in it, with limits and a filter of system
// calls. When the program ends, or the time is over, its process namespace ends, and so does every process in
// it. Then the keeper sends the output and the result through a pipe.
//
// Between fork and exec only functions that are safe after a fork of a process with threads are called: all
// memory is taken before.
//
// Sources: user_namespaces(7), pid_namespaces(7), mount_namespaces(7), pivot_root(2), mount_setattr(2),
// seccomp(2) of the Linux manual pages.
#include "base/sandbox.h"

#include <algorithm>
#include <filesystem>

#include "base/budget.h"
#include "base/error.h"
#include "base/files/file.h"
#include "base/os/linux.h"
#include "base/os/process.h"

#if defined(TRACE_OS_LINUX)

#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/mount.h>
#include <linux/seccomp.h>
#include <poll.h>
#include <sched.h>
#include <signal.h>
#include <sys/mount.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace trace {
namespace {

namespace fs = std::filesystem;

constexpr const char *kProgramFolder = "/program", *kInputFolder = "/scene", *kOutputFolder = "/out";
constexpr std::size_t kMostSaid = 2000;
constexpr int kMostProcesses = 64, kMostOpenFiles = 256;

std::string replacedAll(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != text.npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

/// The head of the keeper's message; the printed text and the output follow.
struct Report {
  SandboxResult::End end = SandboxResult::End::couldNotStart;
  int code = 0;
  double cpuSeconds = 0;
  SandboxResult::Output output = SandboxResult::Output::none;
  std::uint64_t said = 0, bytes = 0;
};

// --- the filter of system calls ---

constexpr std::uint32_t kArchitecture =
#if defined(__x86_64__)
    AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
    AUDIT_ARCH_AARCH64;
#else
    0;
#endif

/// Calls that a ray tracer has no use for, and that reach deep into the kernel.
constexpr std::array kRefusedCalls{SYS_ptrace,
                                   SYS_process_vm_readv,
                                   SYS_process_vm_writev,
                                   SYS_mount,
                                   SYS_umount2,
                                   SYS_pivot_root,
                                   SYS_setns,
                                   SYS_unshare,
                                   SYS_bpf,
                                   SYS_perf_event_open,
                                   SYS_userfaultfd,
                                   SYS_keyctl,
                                   SYS_add_key,
                                   SYS_request_key,
                                   SYS_init_module,
                                   SYS_finit_module,
                                   SYS_delete_module,
                                   SYS_kexec_load,
                                   SYS_reboot,
                                   SYS_swapon,
                                   SYS_swapoff,
                                   SYS_chroot,
                                   SYS_open_by_handle_at,
                                   SYS_io_uring_setup,
                                   SYS_move_mount,
                                   SYS_open_tree,
                                   SYS_fsopen,
                                   SYS_fsmount,
                                   SYS_mount_setattr,
                                   SYS_acct,
                                   SYS_quotactl,
                                   SYS_name_to_handle_at};

constexpr std::size_t kFilterLength = 2 * kRefusedCalls.size() + 7;
using Filter = std::array<sock_filter, kFilterLength>;

constexpr Filter filterOfCalls() {
  constexpr auto statement = [](int code, std::uint32_t k) {
    return sock_filter{static_cast<std::uint16_t>(code), 0, 0, k};
  };
  constexpr auto jumpIf = [](int test, std::uint32_t k, int yes, int no) {
    return sock_filter{static_cast<std::uint16_t>(BPF_JMP | test | BPF_K), static_cast<std::uint8_t>(yes),
                       static_cast<std::uint8_t>(no), k};
  };
  Filter filter{};
  std::size_t n = 0;
  filter[n++] = statement(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, arch));
  filter[n++] = jumpIf(BPF_JEQ, kArchitecture, 1, 0);
  filter[n++] = statement(BPF_RET | BPF_K, SECCOMP_RET_KILL_PROCESS);
  filter[n++] = statement(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr));
  for (const long call : kRefusedCalls) {
    filter[n++] = jumpIf(BPF_JEQ, static_cast<std::uint32_t>(call), 0, 1);
    filter[n++] = statement(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | EPERM);
  }
  filter[n++] = jumpIf(BPF_JGE, 0x40000000u, 0, 1);  // calls of x32
  filter[n++] = statement(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | EPERM);
  filter[n++] = statement(BPF_RET | BPF_K, SECCOMP_RET_ALLOW);
  return filter;
}

// --- the keeper ---

/// All that the keeper needs, made before the fork.
struct Plan {
  bool isolated = true;
  std::string command, root, output, log, uidMap, gidMap, tmpOptions;
  std::string folderPath, inputFolder;  ///< absolute
  int folder = -1;                      ///< the program's, opened
  SandboxLimits limits;
  int report = -1;  ///< the pipe's end
};

double now() {
  timespec time{};
  ::clock_gettime(CLOCK_MONOTONIC, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

bool writeAll(int to, const void* bytes, std::size_t count) {
  const char* at = static_cast<const char*>(bytes);
  while (count > 0) {
    const ssize_t written = ::write(to, at, count);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    at += written;
    count -= static_cast<std::size_t>(written);
  }
  return true;
}

bool writeText(const char* file, const std::string& text) {
  const int to = ::open(file, O_WRONLY | O_CLOEXEC);
  const bool done = to >= 0 && writeAll(to, text.data(), text.size());
  if (to >= 0) ::close(to);
  return done;
}

/// Sends that nothing was run, and why, and ends the keeper.
[[noreturn]] void giveUp(const Plan& plan, SandboxResult::End end, const char* what) {
  char text[200];
  const int length = std::snprintf(text, sizeof text, "%s: %s", what, std::strerror(errno));
  Report report;
  report.end = end;
  report.said = static_cast<std::uint64_t>(std::clamp(length, 0, static_cast<int>(sizeof text) - 1));
  writeAll(plan.report, &report, sizeof report);
  writeAll(plan.report, text, report.said);
  ::_exit(0);
}

bool setReadOnly(const char* place, bool below) {
  struct mount_attr attributes {};
  attributes.attr_set = MOUNT_ATTR_RDONLY | MOUNT_ATTR_NOSUID | MOUNT_ATTR_NODEV;
  return ::syscall(SYS_mount_setattr, AT_FDCWD, place, below ? AT_RECURSIVE : 0, &attributes,
                   sizeof attributes) == 0;
}

/// Folders and files of the system that programs need, links as links.
constexpr std::array kReadable{"/usr",
                               "/bin",
                               "/sbin",
                               "/lib",
                               "/lib32",
                               "/lib64",
                               "/libx32",
                               "/opt",
                               "/etc/alternatives",
                               "/etc/fonts",
                               "/etc/ld.so.cache",
                               "/etc/ld.so.conf",
                               "/etc/ld.so.conf.d",
                               "/etc/localtime"};
constexpr std::array kDevices{"/dev/null", "/dev/zero", "/dev/full", "/dev/random", "/dev/urandom"};

/// The text of a path below the new root, in the buffer.
const char* below(const Plan& plan, const char* path, char* buffer, std::size_t size) {
  std::snprintf(buffer, size, "%s%s", plan.root.c_str(), path);
  return buffer;
}

void makePlace(const Plan& plan, const char* path, bool isFolder) {
  char place[512];
  below(plan, path, place, sizeof place);
  if (isFolder) {
    ::mkdir(place, 0755);
    return;
  }
  const int file = ::open(place, O_WRONLY | O_CREAT | O_CLOEXEC, 0644);
  if (file >= 0) ::close(file);
}

void showOfSystem(const Plan& plan, const char* path) {
  char place[512], target[512];
  struct stat status {};
  if (::lstat(path, &status) != 0) return;
  below(plan, path, place, sizeof place);
  if (S_ISLNK(status.st_mode)) {
    const ssize_t length = ::readlink(path, target, sizeof target - 1);
    if (length <= 0) return;
    target[length] = 0;
    if (::symlink(target, place) != 0 && errno != EEXIST)
      giveUp(plan, SandboxResult::End::notIsolated, "a link of the system");
    return;
  }
  makePlace(plan, path, S_ISDIR(status.st_mode));
  if (::mount(path, place, nullptr, MS_BIND | MS_REC, nullptr) != 0 || !setReadOnly(place, true))
    giveUp(plan, SandboxResult::End::notIsolated, path);
}

void showFolder(const Plan& plan, const std::string& folder, const char* path) {
  char place[512];
  makePlace(plan, path, true);
  below(plan, path, place, sizeof place);
  if (::mount(folder.c_str(), place, nullptr, MS_BIND | MS_REC, nullptr) != 0 || !setReadOnly(place, true))
    giveUp(plan, SandboxResult::End::notIsolated, path);
}

/// Takes the namespaces and makes the root folder.
void isolate(const Plan& plan) {
  constexpr auto kRefused = SandboxResult::End::notIsolated;
  if (kArchitecture == 0)
    errno = ENOSYS, giveUp(plan, kRefused, "no filter of system calls for this processor");
  if (::unshare(CLONE_NEWUSER | CLONE_NEWNS | CLONE_NEWPID | CLONE_NEWNET | CLONE_NEWIPC | CLONE_NEWUTS) != 0)
    giveUp(plan, kRefused, "the kernel refuses namespaces");
  writeText("/proc/self/setgroups", "deny");
  if (!writeText("/proc/self/uid_map", plan.uidMap) || !writeText("/proc/self/gid_map", plan.gidMap))
    giveUp(plan, kRefused, "the kernel refuses user namespaces");
  if (::mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0)
    giveUp(plan, kRefused, "the kernel refuses own mounts");
  if (::mount("tmpfs", plan.root.c_str(), "tmpfs", MS_NOSUID | MS_NODEV, plan.tmpOptions.c_str()) != 0)
    giveUp(plan, kRefused, "the kernel refuses a folder in memory");
  for (const char* folder : {"/etc", "/dev", "/dev/shm", "/proc", "/tmp", kOutputFolder})
    makePlace(plan, folder, true);
  for (const char* path : kReadable) showOfSystem(plan, path);
  for (const char* device : kDevices) {
    char place[512];
    makePlace(plan, device, false);
    if (::mount(device, below(plan, device, place, sizeof place), nullptr, MS_BIND, nullptr) != 0)
      giveUp(plan, kRefused, device);
  }
  showFolder(plan, plan.folderPath, kProgramFolder);
  showFolder(plan, plan.inputFolder, kInputFolder);
  if (::chdir(plan.root.c_str()) != 0 || ::syscall(SYS_pivot_root, ".", ".") != 0 ||
      ::umount2(".", MNT_DETACH) != 0 || ::chdir("/") != 0)
    giveUp(plan, kRefused, "the kernel refuses another root folder");
}

void limit(int which, std::uint64_t most) {
  const rlimit both{static_cast<rlim_t>(most), static_cast<rlim_t>(most)};
  ::setrlimit(static_cast<__rlimit_resource_t>(which), &both);
}

/// Becomes the program.
[[noreturn]] void becomeProgram(const Plan& plan) {
  const int nothing = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
  const int log = ::open(plan.log.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600);
  if (nothing >= 0) ::dup2(nothing, 0);
  if (log >= 0) ::dup2(log, 1), ::dup2(log, 2);
  if (!plan.isolated && ::fchdir(plan.folder) != 0) ::_exit(126);
  ::syscall(SYS_close_range, 3u, ~0u, 0u);
  ::setpgid(0, 0);
  for (int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGUSR1}) ::signal(signal, SIG_DFL);
  sigset_t none;
  sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  const auto seconds = static_cast<std::uint64_t>(plan.limits.seconds) + 1;
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, seconds);
  limit(RLIMIT_AS, plan.limits.memory);
  limit(RLIMIT_FSIZE, plan.limits.output + 1);
  limit(RLIMIT_NOFILE, kMostOpenFiles);
  if (plan.isolated) limit(RLIMIT_NPROC, kMostProcesses);
  ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
  if (plan.isolated) {
    static constexpr Filter kFilter = filterOfCalls();
    const sock_fprog program{static_cast<unsigned short>(kFilter.size()),
                             const_cast<sock_filter*>(kFilter.data())};
    if (::chdir(kProgramFolder) != 0 || ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) != 0)
      ::_exit(126);
  }
  char path[] = "PATH=/usr/local/bin:/usr/bin:/bin", home[] = "HOME=/tmp", tongue[] = "LANG=C.UTF-8";
  char shell[] = "/bin/sh", option[] = "-c";
  char* environment[] = {path, home, tongue, nullptr};
  char* words[] = {shell, option, const_cast<char*>(plan.command.c_str()), nullptr};
  ::execve(shell, words, environment);
  ::_exit(127);
}

/// The owner asks the keeper to end.
volatile sig_atomic_t isAsked = 0;

/// Waits for the child until that moment; false if it did not end.
bool waitUntil(pid_t child, double end, int& status, rusage& used) {
  for (;;) {
    const pid_t ended = ::wait4(child, &status, WNOHANG, &used);
    if (ended == child) return true;
    if (ended < 0 && errno != EINTR) return true;
    if (isAsked || now() >= end) return false;
    const timespec pause{0, 5'000'000};
    ::nanosleep(&pause, nullptr);
  }
}

double secondsOf(const rusage& used) {
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(used.ru_utime) + seconds(used.ru_stime);
}

/// In its own process namespace: the first process, whose end is that of all others.
[[noreturn]] void beFirstProcess(const Plan& plan) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  ::mount("proc", "/proc", "proc", MS_NOSUID | MS_NODEV | MS_NOEXEC, nullptr);  // some programs do without
  writeText("/proc/sys/user/max_user_namespaces", "0");
  const pid_t program = ::fork();
  if (program == 0) becomeProgram(plan);
  if (program < 0) ::_exit(125);
  int status = 0;
  for (;;) {  // orphans of the program become children of this one
    const pid_t ended = ::wait(&status);
    if (ended == program) break;
    if (ended < 0 && errno != EINTR) ::_exit(125);
  }
  ::kill(-1, SIGKILL);
  int ignored = 0;
  while (::wait(&ignored) > 0 || errno == EINTR) continue;
  // An exit code tells a signal from a code only in another way: the keeper reads it from here.
  const int said[2] = {WIFSIGNALED(status) ? 1 : 0,
                       WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status)};
  const int file = ::open("/.status", O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  if (file >= 0) writeAll(file, said, sizeof said), ::close(file);
  ::_exit(0);
}

/// Kills what the program left running: all have become children of the keeper.
void killOrphans() {
  char file[64], text[4096];
  std::snprintf(file, sizeof file, "/proc/self/task/%d/children", static_cast<int>(::getpid()));
  for (int round = 0; round < 5000; ++round) {
    const int from = ::open(file, O_RDONLY | O_CLOEXEC);
    const ssize_t length = from >= 0 ? ::read(from, text, sizeof text - 1) : 0;
    if (from >= 0) ::close(from);
    if (length <= 0) return;
    text[length] = 0;
    for (char* at = text; *at;) {
      char* end = at;
      const long child = std::strtol(at, &end, 10);
      if (end == at) break;
      if (child > 0) ::kill(static_cast<pid_t>(child), SIGKILL);
      at = end;
    }
    int ignored = 0;
    while (::waitpid(-1, &ignored, WNOHANG) > 0) continue;  // their children come next
    const timespec pause{0, 1'000'000};
    ::nanosleep(&pause, nullptr);
  }
}

/// Sends the report, the end of what was printed, and the output.
void send(const Plan& plan, Report report) {
  char text[kMostSaid];
  const int log = ::open(plan.log.c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC);
  if (log >= 0) {
    const off_t size = ::lseek(log, 0, SEEK_END);
    ::lseek(log, std::max<off_t>(0, size - static_cast<off_t>(sizeof text)), SEEK_SET);
    report.said = static_cast<std::uint64_t>(std::max<ssize_t>(0, ::read(log, text, sizeof text)));
    ::close(log);
  }
  struct stat status {};
  const int output = ::open(plan.output.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (output < 0)
    report.output = errno == ENOENT ? SandboxResult::Output::none : SandboxResult::Output::noFile;
  else if (::fstat(output, &status) != 0 || !S_ISREG(status.st_mode))
    report.output = SandboxResult::Output::noFile;
  else if (static_cast<std::uint64_t>(status.st_size) > plan.limits.output)
    report.output = SandboxResult::Output::tooLarge;
  else
    report.output = SandboxResult::Output::taken, report.bytes = static_cast<std::uint64_t>(status.st_size);
  if (!writeAll(plan.report, &report, sizeof report) || !writeAll(plan.report, text, report.said)) return;
  char buffer[1 << 14];
  for (std::uint64_t left = report.bytes; left > 0;) {
    const ssize_t count = ::read(output, buffer, std::min<std::uint64_t>(left, sizeof buffer));
    if (count <= 0 || !writeAll(plan.report, buffer, static_cast<std::size_t>(count))) return;
    left -= static_cast<std::uint64_t>(count);
  }
}

[[noreturn]] void keep(const Plan& plan, pid_t owner) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != owner) ::_exit(1);
  for (int signal : {SIGINT, SIGHUP}) ::signal(signal, SIG_IGN);  // the owner decides
  ::signal(SIGTERM, [](int) { isAsked = 1; });
  if (plan.isolated)
    isolate(plan);
  else
    ::prctl(PR_SET_CHILD_SUBREAPER, 1);
  const double begin = now();
  const pid_t child = ::fork();
  if (child == 0) {
    if (plan.isolated) beFirstProcess(plan);
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    becomeProgram(plan);
  }
  if (child < 0) giveUp(plan, SandboxResult::End::couldNotStart, "no process could be started");
  int status = 0;
  rusage used{};
  Report report;
  const bool ended = waitUntil(child, begin + plan.limits.seconds, status, used);
  if (!ended) {
    ::kill(child, SIGKILL);
    while (::wait4(child, &status, 0, &used) < 0 && errno == EINTR) continue;
  }
  if (!plan.isolated) killOrphans();
  rusage all{};
  ::getrusage(RUSAGE_CHILDREN, &all);
  report.cpuSeconds = secondsOf(all);
  int said[2] = {WIFSIGNALED(status) ? 1 : 0, WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status)};
  if (plan.isolated && ended) {
    const int file = ::open("/.status", O_RDONLY | O_CLOEXEC);
    if (file < 0 || ::read(file, said, sizeof said) != sizeof said) said[0] = 1, said[1] = SIGKILL;
    if (file >= 0) ::close(file);
  }
  const bool cpuOver = said[0] == 1 && (said[1] == SIGXCPU ||
                                        (said[1] == SIGKILL && report.cpuSeconds >= plan.limits.seconds));
  report.end = !ended || cpuOver ? SandboxResult::End::timeLimit
               : said[0]         ? SandboxResult::End::killed
                                 : SandboxResult::End::exited;
  report.code = said[1];
  send(plan, report);
  ::_exit(0);
}

// --- the owner ---

/// A descriptor that closes itself.
struct OpenFile {
  int number = -1;
  OpenFile() = default;
  explicit OpenFile(int n) : number(n) {}
  ~OpenFile() { reset(); }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  void reset() {
    if (number >= 0) ::close(number);
    number = -1;
  }
};

/// A folder that is removed with this.
struct OwnFolder {
  const std::string path = makeOwnFolder();
  OwnFolder() = default;
  ~OwnFolder() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
  OwnFolder(const OwnFolder&) = delete;
  OwnFolder& operator=(const OwnFolder&) = delete;
};

/// The keeper; killed with this, and all that it started with it.
struct Keeper {
  pid_t process;
  explicit Keeper(pid_t p) : process(p) {}
  ~Keeper() {
    constexpr double kPatience = 5;  // seconds
    int ignored = 0;
    ::kill(process, SIGTERM);
    for (const double end = now() + kPatience; now() < end;) {
      if (::waitpid(process, &ignored, WNOHANG) == process) return;
      const timespec pause{0, 1'000'000};
      ::nanosleep(&pause, nullptr);
    }
    ::kill(process, SIGKILL);
    while (::waitpid(process, &ignored, 0) < 0 && errno == EINTR) continue;
  }
  Keeper(const Keeper&) = delete;
  Keeper& operator=(const Keeper&) = delete;
};

/// All that comes through the pipe until its end, or the end of the time.
std::string received(int from, double seconds) {
  constexpr int kLook = 50;  // milliseconds
  std::string bytes;
  const double end = now() + seconds;
  char buffer[1 << 14];
  while (now() < end) {
    lookAtBudget();
    pollfd ready{from, POLLIN, 0};
    if (::poll(&ready, 1, kLook) <= 0) continue;
    const ssize_t count = ::read(from, buffer, sizeof buffer);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) break;
    bytes.append(buffer, static_cast<std::size_t>(count));
  }
  return bytes;
}

Plan planOf(const SandboxJob& job, const std::string& own) {
  Plan plan;
  plan.isolated = job.isolated;
  plan.limits = job.limits;
  plan.root = own;
  plan.output = outputPath(job, own);
  plan.log = job.isolated ? "/.log" : own + "/.log";
  plan.folderPath = fs::absolute(job.folder).string();
  plan.inputFolder = fs::absolute(job.input).parent_path().string();
  plan.uidMap = "1000 " + std::to_string(::geteuid()) + " 1\n";
  plan.gidMap = "1000 " + std::to_string(::getegid()) + " 1\n";
  plan.tmpOptions = "size=" + std::to_string(4 * job.limits.output) + ",nr_inodes=10000,mode=755";
  plan.command = replacedAll(job.command, "{scene}", os::quotedForShell(inputPath(job)));
  plan.command = replacedAll(plan.command, "{out}", os::quotedForShell(plan.output));
  return plan;
}

/// The signal that ended the program or, as a shell reports it, a program that it started; 0 if none did.
int signalOf(const Report& report) {
  constexpr int kSignals =
      128;  // the exit code of a shell whose program was ended by a signal is larger by this
  if (report.end == SandboxResult::End::killed) return report.code;
  const int signal = report.end == SandboxResult::End::exited ? report.code - kSignals : 0;
  return signal > 0 && signal < NSIG ? signal : 0;
}

}  // namespace

std::string inputPath(const SandboxJob& job) {
  if (!job.isolated) return fs::absolute(job.input).string();
  return std::string(kInputFolder) + "/" + fs::path(job.input).filename().string();
}

std::string outputPath(const SandboxJob& job, const std::string& ownFolder) {
  return (job.isolated ? std::string(kOutputFolder) : ownFolder) + "/" + job.outputName;
}

SandboxResult runSandboxed(const SandboxJob& job) {
  const OwnFolder own;
  Plan plan = planOf(job, own.path);
  const OpenFile folder(::open(plan.folderPath.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC));
  if (folder.number < 0) return {.said = "its folder cannot be opened: " + std::string(std::strerror(errno))};
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) return {.said = "no pipe: " + std::string(std::strerror(errno))};
  OpenFile from(ends[0]), to(ends[1]);
  plan.folder = folder.number;
  plan.report = to.number;
  const pid_t owner = ::getpid();
  const pid_t child = ::fork();
  if (child == 0) keep(plan, owner);
  if (child < 0) return {.said = "no process could be started: " + std::string(std::strerror(errno))};
  const Keeper keeper(child);
  to.reset();
  constexpr double kMore = 20;  // seconds, to take down what runs and to send
  const std::string bytes = received(from.number, job.limits.seconds + kMore);
  Report report;
  if (bytes.size() < sizeof report) return {.said = "its keeper ended early"};
  std::memcpy(&report, bytes.data(), sizeof report);
  SandboxResult result{
      .end = report.end, .code = report.code, .cpuSeconds = report.cpuSeconds, .output = report.output};
  if (const int signal = signalOf(report)) result.signal = ::strsignal(signal);
  if (report.end == SandboxResult::End::killed && report.code == SIGXFSZ)
    result.output = SandboxResult::Output::tooLarge;
  if (report.said > kMostSaid || bytes.size() - sizeof report != report.said + report.bytes) {
    result.output = SandboxResult::Output::none;
    return result;
  }
  result.said = bytes.substr(sizeof report, report.said);
  result.bytes = bytes.substr(sizeof report + report.said);
  return result;
}

std::string whyNotIsolated() {
  const OwnFolder own;
  SandboxJob job;
  job.command = "exit 0";
  job.folder = own.path;
  job.input = own.path + "/none";
  job.outputName = "none";
  const SandboxResult result = runSandboxed(job);
  return result.end == SandboxResult::End::exited && result.code == 0 ? ""
         : result.said.empty()                                        ? "the program did not start"
                                                                      : result.said;
}

}  // namespace trace

#endif
