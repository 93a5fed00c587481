from spack.package import *
from spack_repo.builtin.build_systems.cmake import CMakePackage


class Hooke(CMakePackage):
    """Mass-spring systems, and how much accuracy each method of integration buys for its cost."""

    homepage = "https://github.com/OWNER/hooke"
    url = "https://github.com/OWNER/hooke/releases/download/v0.3.0/hooke-0.3.0.tar.gz"

    license("MIT")

    version("0.3.0", sha256="0000000000000000000000000000000000000000000000000000000000000000")

    parts = {
        "sundials": "sundials+cvode+arkode",
        "cholmod": "suite-sparse",
        "lapack": "lapack",
        "gsl": "gsl",
        "hdf5": "hdf5~mpi",
    }
    for part, package in parts.items():
        variant(part, default=part in ("sundials", "lapack", "hdf5"), description=f"Use {package}")
        depends_on(package, when=f"+{part}")

    depends_on("c", type="build")
    depends_on("cmake@3.22:", type="build")
    depends_on("python@3.8:", type="build")

    def cmake_args(self):
        args = [self.define_from_variant(f"HOOKE_{part.upper()}", part) for part in self.parts]
        return args + ["-DBUILD_TESTING=OFF", "-DHOOKE_CHARTJS=OFF", "-DHOOKE_THREEJS=OFF"]
