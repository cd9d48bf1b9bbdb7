// Drives the CXXRTL device: clocks, pin changes, processor time, end state.

#include <cstdint>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <vector>

#include "cxxrtl_device.cc"

struct Event {
    uint64_t clock;
    unsigned pin;
    uint64_t value;
};

static cxxrtl_design::p_device top;

static void set(unsigned pin, uint64_t value) {
    switch (pin) {
@PINS@    }
}

// How a design describes itself has changed between versions: the newer way where there is one.
template <class Design>
static auto describe(Design& design, cxxrtl::debug_items& items, int)
    -> decltype(design.debug_info(&items, nullptr, std::string())) {
    design.debug_info(&items, nullptr, std::string());
}

template <class Design>
static void describe(Design& design, cxxrtl::debug_items& items, long) {
    design.debug_info(items);
}

static void print(uint64_t word) { std::printf("%lx ", word); }

static uint64_t word(cxxrtl::debug_items& items, const char* path) {
    return *items[path].curr;
}

int main(int, char** arguments) {
    std::ifstream file(arguments[1]);
    uint64_t clocks = 0, count = 0, clock = 0;
    file >> clocks >> count;
    std::vector<Event> events(count);
    for (Event& event : events) file >> event.clock >> event.pin >> event.value;
    top.step();
    const std::clock_t before = std::clock();
    auto run_until = [&](uint64_t until) {
        for (; clock < until; ++clock) {
            top.p_clock.data[0] = 1;
            top.step();
            top.p_clock.data[0] = 0;
            top.step();
        }
    };
    for (const Event& event : events) {
        run_until(event.clock);
        set(event.pin, event.value);
    }
    run_until(clocks);
    std::printf("end %.9f ", double(std::clock() - before) / CLOCKS_PER_SEC);
    cxxrtl::debug_items items;
    describe(top, items, 0);
@STATE@    std::printf("\n");
}
