# For who types make: builds build/release/bin/ray by CMake and Ninja, with the libraries that are installed. `./dev build`
# also installs those that are missing.
ray all:
	cmake --preset release
	cmake --build --preset release $(if $(filter ray,$@),--target ray)

test: all
	ctest --preset release

clean:
	rm -rf build/release

.PHONY: ray all test clean
