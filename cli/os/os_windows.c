#define _CRT_RAND_S /* rand_s() */
#include "os.h"

#include <errno.h>
#include <fcntl.h>
#include <io.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <windows.h>
/* after windows.h */
#include <psapi.h>
#include <shellapi.h>

void cli_os_begin(void) {
  static const DWORD streams[] = {STD_OUTPUT_HANDLE, STD_ERROR_HANDLE};
  for (int k = 0; k < 2; k++) {
    DWORD mode;
    HANDLE stream = GetStdHandle(streams[k]);
    if (!GetConsoleMode(stream, &mode)) continue;
    SetConsoleMode(stream, mode | ENABLE_VIRTUAL_TERMINAL_PROCESSING);
    SetConsoleOutputCP(CP_UTF8);
  }
  _setmode(0, _O_BINARY);
  _setmode(1, _O_BINARY);
  _setmode(2, _O_BINARY);
}

static void (*on_interrupt)(int number);

static BOOL WINAPI hear(DWORD event) {
  if (event != CTRL_C_EVENT && event != CTRL_BREAK_EVENT) return FALSE;
  on_interrupt(SIGINT);
  return TRUE;
}

void cli_os_catch_interrupts(void (*interrupt)(int number)) {
  on_interrupt = interrupt;
  SetConsoleCtrlHandler(hear, TRUE);
}

int32_t cli_os_processors(void) {
  SYSTEM_INFO info;
  GetSystemInfo(&info);
  return info.dwNumberOfProcessors > 0 ? (int32_t)info.dwNumberOfProcessors : 1;
}

void cli_os_memory(int64_t *now, int64_t *most) {
  PROCESS_MEMORY_COUNTERS memory = {.cb = sizeof memory};
  if (!K32GetProcessMemoryInfo(GetCurrentProcess(), &memory, sizeof memory)) return;
  *now = (int64_t)memory.WorkingSetSize;
  *most = (int64_t)memory.PeakWorkingSetSize;
}

void cli_os_give_back_memory(void) {
}

const char *cli_os_load(const char *path, const char *const name[2], void *symbol[2]) {
  HMODULE library = LoadLibraryA(path);
  for (int k = 0; library && k < 2; k++)
    symbol[k] = (void *)(uintptr_t)GetProcAddress(library, name[k]);
  return library ? NULL : "the system refuses it";
}

/* ---- files ---- */

const char *cli_os_last_slash(const char *path) {
  const char *forward = strrchr(path, '/'), *back = strrchr(path, '\\');
  return back > forward ? back : forward;
}

static int look(const char *path, BY_HANDLE_FILE_INFORMATION *there) {
  HANDLE file =
      CreateFileA(path, FILE_READ_ATTRIBUTES, FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE, NULL,
                  OPEN_EXISTING, FILE_FLAG_BACKUP_SEMANTICS, NULL);
  const int found = file != INVALID_HANDLE_VALUE && GetFileInformationByHandle(file, there);
  if (file != INVALID_HANDLE_VALUE) CloseHandle(file);
  return found;
}

int32_t cli_os_is_same_file(const char *one, const char *other) {
  BY_HANDLE_FILE_INFORMATION first, second;
  return look(one, &first) && look(other, &second) &&
         first.dwVolumeSerialNumber == second.dwVolumeSerialNumber &&
         first.nFileIndexHigh == second.nFileIndexHigh && first.nFileIndexLow == second.nFileIndexLow;
}

int cli_os_make_file(char *path) {
  static const char letters[] = "0123456789abcdefghijklmnopqrstuv";
  int descriptor;
  do {
    unsigned number;
    if (rand_s(&number) != 0) return -1;
    for (char *at = path + strlen(path) - 6; *at; at++, number >>= 5)
      *at = letters[number & 31];
    descriptor = _open(path, _O_CREAT | _O_EXCL | _O_RDWR | _O_BINARY, _S_IREAD | _S_IWRITE);
  } while (descriptor < 0 && errno == EEXIST);
  return descriptor < 0 ? -1 : _close(descriptor);
}

int32_t cli_os_show_page(const char *page) {
  return (intptr_t)ShellExecuteA(NULL, "open", page, NULL, NULL, SW_SHOWNORMAL) > 32;
}
