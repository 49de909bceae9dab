# @HOLDFAST_...@ is filled in by tools/package recipes (.github/workflows/release.yml).
class Holdfast < Formula
  desc "Suspended cables under digital vibration control"
  homepage "https://github.com/@HOLDFAST_REPOSITORY@"
  url "https://github.com/@HOLDFAST_REPOSITORY@/releases/download/v@HOLDFAST_VERSION@/holdfast-@HOLDFAST_VERSION@.tar.gz"
  sha256 "@HOLDFAST_SHA256@"
  license "BSD-3-Clause"

  depends_on "cli11" => :build
  depends_on "cmake" => :build
  depends_on "ninja" => :build
  depends_on "nlohmann-json" => :build
  depends_on "xsimd" => :build
  depends_on "ceres-solver"
  depends_on "eigen"
  depends_on "gnuplot"
  depends_on "netcdf"
  depends_on "sundials"
  depends_on "tbb"
  depends_on "tomlplusplus"
  depends_on "zstd"

  def install
    system "cmake", "-S", ".", "-B", "build", "-G", "Ninja",
           "-DHOLDFAST_BUILD_TESTS=OFF", "-DHOLDFAST_JOIN_SOURCES=ON",
           *std_cmake_args
    system "cmake", "--build", "build"
    system "cmake", "--install", "build"
  end

  test do
    assert_match version.to_s, shell_output("#{bin}/holdfast --version")
    system bin/"holdfast", "report", "--output", "report"
    assert_path_exists testpath/"report/report.html"
  end
end
