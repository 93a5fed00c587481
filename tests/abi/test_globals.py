"""The library has no global variables but those listed here, and calls nothing that prints, ends the process, changes
its settings, or is not thread-safe."""

import os
import re
import subprocess

import pytest

# The message of the thread, its text about the BLAS, a lock around each library that allows one thread at a time, and what the processor runs.
VARIABLES = {"status.c.o": {"last"}, "build_fact.c.o": {"blas"}, "file_h5.c.o": {"alone", "guards"},
             "spring_choose.c.o": {"known"}, "handle.c.o": {"alive", "mutex"}}  # of builds that check handles

FORBIDDEN = set(
    "exit _exit _Exit quick_exit abort __assert_fail atexit at_quick_exit raise kill "
    "printf puts putchar vprintf perror psignal stdout stderr stdin __printf_chk __vprintf_chk "
    "signal sigaction sigprocmask sigsuspend alarm setitimer siglongjmp longjmp _setjmp __sigsetjmp "
    "setlocale setenv putenv unsetenv getenv secure_getenv chdir fchdir umask fork vfork system popen execve "
    "rand srand random srandom drand48 lrand48 strtok strerror strsignal asctime ctime gmtime localtime "
    "tmpnam tempnam mktemp getpwnam getpwuid getgrnam readdir ttyname basename dirname "
    "fesetround fesetenv feenableexcept fedisableexcept feholdexcept feupdateenv lgamma "
    "dlopen openlog syslog setrlimit prctl".split()
)


def nm(*arguments):
    return subprocess.run([os.environ["HOOKE_NM"], *arguments], capture_output=True, text=True, check=True).stdout


def variables(text):
    """{object: names} of all writable data in the output of nm on an archive: data, bss, common, including
    thread-local."""
    found, name = {}, None
    for line in text.splitlines():
        if match := re.fullmatch(r"(\S+\.o):", line):
            name = match.group(1)
        elif match := re.fullmatch(r"[0-9a-f]+ ([bBdDcCsSgG]) (\S+)", line):
            found.setdefault(name, set()).add(match.group(2))
    return found


def sections(archive):
    """{object: names of constants}: tables of pointers, which the loader relocates before they become read-only."""
    text = subprocess.run(["objdump", "-t", archive], capture_output=True, text=True, check=True).stdout
    found, name = {}, None
    for line in text.splitlines():
        if match := re.match(r"(\S+\.o): +file format", line):
            name = match.group(1)
        elif match := re.match(r"[0-9a-f]+ .{7} (\.data\.rel\.ro\S*|\.rodata\S*)\t[0-9a-f]+ +(?:\.hidden )?(\S+)", line):
            found.setdefault(name, set()).add(match.group(2))
    return found


def outliving(archive):
    constant = sections(archive)
    found = {o: {n for n in names - constant.get(o, set()) if not n.startswith((".", "DW."))}
             for o, names in variables(nm(archive)).items()}
    return {o: names for o, names in found.items() if names}


def called(archive):
    return {line.split()[-1].split("@")[0] for line in nm("-u", archive).splitlines() if line.strip().startswith("U ")}


def test_nothing_outlives_a_call():
    found = {o: names - VARIABLES.get(o, set()) for o, names in outliving(os.environ["HOOKE_STATIC_LIBRARY"]).items()}
    assert {o: names for o, names in found.items() if names} == {}


def test_the_message_is_of_a_thread():
    text = subprocess.run(["objdump", "-t", os.environ["HOOKE_STATIC_LIBRARY"]], capture_output=True, text=True, check=True).stdout
    assert re.search(r"\.tbss\t[0-9a-f]+ last$", text, re.MULTILINE)


def test_nothing_forbidden_is_called():
    assert called(os.environ["HOOKE_STATIC_LIBRARY"]) & FORBIDDEN == set()


PLANTED = """
#include <stdio.h>
#include <stdlib.h>
static int count = 1;
static int zeros[4];
static const char *const names[] = {"a", "b"};
const char *hooke_next(int k) { zeros[k] += count++; if (k > 9) { printf("%d", zeros[0]); exit(1); } return names[k]; }
"""


@pytest.fixture
def planted(tmp_path):
    (tmp_path / "planted.c").write_text(PLANTED)
    plain = ["-O1", "-fPIC", "-U_FORTIFY_SOURCE"]  # Ubuntu's gcc calls __printf_chk() otherwise
    subprocess.run([os.environ["HOOKE_CC"], *plain, "-c", "planted.c", "-o", "planted.c.o"], cwd=tmp_path, check=True)
    subprocess.run(["ar", "rc", "libplanted.a", "planted.c.o"], cwd=tmp_path, check=True)
    return str(tmp_path / "libplanted.a")


def test_planted_variables(planted):
    assert outliving(planted) == {"planted.c.o": {"count", "zeros"}}


def test_planted_calls(planted):
    assert called(planted) & FORBIDDEN == {"exit", "printf"}
