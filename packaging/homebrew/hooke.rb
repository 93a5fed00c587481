class Hooke < Formula
  desc "Mass-spring systems, and what accuracy each method of integration costs"
  homepage "https://github.com/OWNER/hooke"
  url "https://github.com/OWNER/hooke/releases/download/v0.3.0/hooke-0.3.0.tar.gz"
  sha256 "0000000000000000000000000000000000000000000000000000000000000000"
  license "MIT"

  depends_on "cmake" => :build
  depends_on "hdf5"
  depends_on "sundials"
  uses_from_macos "python" => :build

  def install
    without = %w[CHOLMOD GSL CHARTJS THREEJS].map { |part| "-DHOOKE_#{part}=OFF" }
    system "cmake", "-S", ".", "-B", "build", "-DBUILD_TESTING=OFF", *without, *std_cmake_args
    system "cmake", "--build", "build"
    system "cmake", "--install", "build"
  end

  test do
    assert_match version.to_s, shell_output("#{bin}/hooke --version")
    system bin/"hooke", "run", share/"hooke/examples/scenes/oscillator.json", "--duration", "0.1"
  end
end
