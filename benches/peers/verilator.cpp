// Drives the verilated device: clocks, pin changes, processor time, end state.

#include <cstdint>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <vector>

#include "Vdevice.h"
#include "Vdevice___024root.h"

struct Event {
    uint64_t clock;
    unsigned pin;
    uint64_t value;
};

static Vdevice top;

static void set(unsigned pin, uint64_t value) {
    switch (pin) {
@PINS@    }
}

static void print(uint64_t word) { std::printf("%lx ", word); }

int main(int, char** arguments) {
    std::ifstream file(arguments[1]);
    uint64_t clocks = 0, count = 0, clock = 0;
    file >> clocks >> count;
    std::vector<Event> events(count);
    for (Event& event : events) file >> event.clock >> event.pin >> event.value;
    top.clock = 0;
    top.eval();
    const std::clock_t before = std::clock();
    auto run_until = [&](uint64_t until) {
        for (; clock < until; ++clock) {
            top.clock = 1;
            top.eval();
            top.clock = 0;
            top.eval();
        }
    };
    for (const Event& event : events) {
        run_until(event.clock);
        set(event.pin, event.value);
    }
    run_until(clocks);
    std::printf("end %.9f ", double(std::clock() - before) / CLOCKS_PER_SEC);
@STATE@    std::printf("\n");
}
