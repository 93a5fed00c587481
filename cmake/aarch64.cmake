# Compiles for AArch64 with Debian's gcc-aarch64-linux-gnu; programs run under qemu-aarch64-static. Only libraries of
# that architecture are used (dpkg --add-architecture arm64), never those of this machine.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_C_COMPILER aarch64-linux-gnu-gcc)
set(CMAKE_C_LIBRARY_ARCHITECTURE aarch64-linux-gnu)
set(CMAKE_LIBRARY_ARCHITECTURE aarch64-linux-gnu)
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-aarch64-static)
set(CMAKE_SYSTEM_IGNORE_PATH /lib/x86_64-linux-gnu /usr/lib/x86_64-linux-gnu)
