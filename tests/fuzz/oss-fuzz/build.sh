#!/bin/bash -eu
# Builds every target of tests/fuzz the way OSS-Fuzz asks for: with $CC, $CFLAGS and $LIB_FUZZING_ENGINE, into $OUT, each with
# its seeds, its dictionary and its longest input; the libraries and files that it needs to run come along.
# By hand: SRC=the folder that holds hooke, WORK and OUT two folders of your own, CC=clang,
# CFLAGS='-O1 -fsanitize=fuzzer-no-link,address', LIB_FUZZING_ENGINE=-fsanitize=fuzzer.

here=$SRC/hooke/tests/fuzz
without=()
for part in SUNDIALS CHOLMOD LAPACK GSL CHARTJS THREEJS; do without+=("-DHOOKE_$part=OFF"); done
cmake -S "$SRC/hooke" -B "$WORK/build" -G Ninja -DCMAKE_BUILD_TYPE=None -DCMAKE_C_COMPILER="$CC" -DCMAKE_C_FLAGS="$CFLAGS" \
  -DHOOKE_FUZZING_ENGINE="$LIB_FUZZING_ENGINE" -DHOOKE_FUZZ=ON -DHOOKE_BUILD_CLI=OFF -DHOOKE_WERROR=OFF \
  -DHOOKE_KERNEL_OPTIMISATION=-O1 -DHOOKE_KERNEL_COPIES=OFF -DHOOKE_HDF5=ON "${without[@]}" \
  -DCMAKE_BUILD_WITH_INSTALL_RPATH=ON -DCMAKE_INSTALL_RPATH='$ORIGIN/lib' \
  -DCMAKE_EXE_LINKER_FLAGS=-Wl,--disable-new-dtags # so that the libraries find theirs there, too
cmake --build "$WORK/build" --target hooke_fuzz

mkdir -p "$OUT/lib"
cp -r "$here/files" "$OUT" # which scenes name
for source in "$here"/fuzz_*.c; do
  name=$(basename "$source" .c)
  name=${name#fuzz_}
  target=$OUT/fuzz_$name
  built=$WORK/build/tests/fuzz/fuzz_$name
  cp "$built" "$target"
  ldd "$built" | awk '$3 ~ /^\// && $1 !~ /^(libc|libm|libpthread|libdl|librt|libgcc_s|libstdc\+\+)\./ {print $3}' |
    xargs -r cp -L -t "$OUT/lib"
  inputs=$WORK/inputs/$name
  rm -rf "$inputs" "${target}_seed_corpus.zip"
  mkdir -p "$inputs"
  tar -xJf "$here/inputs/$name.tar.xz" -C "$inputs"
  find "$inputs" -type f -not -path "$inputs/campaign/*" | zip -q -j "${target}_seed_corpus.zip" -@
  if [ -e "$here/$name.dict" ]; then cp "$here/$name.dict" "$target.dict"; fi
  printf '[libfuzzer]\nmax_len = %s\n' "$(sed -n 's/.*Longest input: \([0-9]*\).*/\1/p' "$source")" >"$target.options"
done
