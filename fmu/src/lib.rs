//! Device and machine as a unit for co-simulation, by the Functional Mock-up Interface 3.0.
//!
//! Whoever runs the unit sets the two switches and says how far to go; the unit runs the device
//! clock by clock up to there, in closed loop with the machine of its `machine.toml`, and shows
//! what `helixlock sim` shows. Where the pass ends the machine stands, and steps may be played back.

use std::path::Path;

use fmi::fmi3::{Fmi3Error, Fmi3Res};
use fmi_export::FmuModel;
use fmi_export::fmi3::{CSDoStepResult, Context, DefaultLoggingCategory, UserModel};
use helixlock_netlist::SignalId;
use helixlock_plant::Model;
use helixlock_sim::{DeviceEngine, Engine, Options, UnderWay};

/// The machine file among the unit's resources.
pub const MACHINE: &str = "machine.toml";

/// A lead-screw grinder and its digital correction device, in closed loop.
#[derive(FmuModel, Default, Debug)]
#[model(model_exchange = false, co_simulation = true, user_model = false)]
pub struct Grinder {
    /// The loop is closed as soon as the initial phase is selected.
    #[variable(causality = Input, variability = Discrete, start = true)]
    pub correct: bool,
    /// Counted steps are played back towards zero.
    #[variable(causality = Input, variability = Discrete, start = false)]
    pub playback: bool,
    /// Nominal position on the workpiece, mm.
    #[variable(causality = Output, start = 0.0, initial = Exact)]
    pub position_mm: f64,
    /// How much longer than nominal the thread is there, µm.
    #[variable(causality = Output, start = 0.0, initial = Exact)]
    pub lead_error_um: f64,
    /// What the motor has moved the table, µm.
    #[variable(causality = Output, start = 0.0, initial = Exact)]
    pub correction_um: f64,
    /// The recorder's reading of the last comparison, µm, positive when the laser lags.
    #[variable(causality = Output, variability = Discrete, start = 0.0, initial = Exact)]
    pub error_um: f64,
    /// Comparisons so far.
    #[variable(causality = Output, variability = Discrete, start = 0, initial = Exact)]
    pub comparisons: i32,
    /// Net steps of the motor, forward positive.
    #[variable(causality = Output, variability = Discrete, start = 0, initial = Exact)]
    pub steps: i32,
    /// The reset counter: steps away from zero, 0 to 4095.
    #[variable(causality = Output, variability = Discrete, start = 0, initial = Exact)]
    pub count: u16,
    /// On which side of zero it counts.
    #[variable(causality = Output, variability = Discrete, start = false, initial = Exact)]
    pub count_forward: bool,
    /// Nothing is counted.
    #[variable(causality = Output, variability = Discrete, start = false, initial = Exact)]
    pub zero: bool,
    /// The counter was full, and a step was refused.
    #[variable(causality = Output, variability = Discrete, start = false, initial = Exact)]
    pub fault: bool,
    /// The initial phase is selected, lines are compared.
    #[variable(causality = Output, variability = Discrete, start = false, initial = Exact)]
    pub measuring: bool,
    /// The phase meter.
    #[variable(causality = Output, variability = Discrete, start = false, initial = Exact)]
    pub t1: bool,
    /// Phase A of the ring distributor.
    #[variable(causality = Output, variability = Discrete, start = false, initial = Exact)]
    pub phase_a: bool,
    /// Phase B.
    #[variable(causality = Output, variability = Discrete, start = false, initial = Exact)]
    pub phase_b: bool,
    /// Phase C.
    #[variable(causality = Output, variability = Discrete, start = false, initial = Exact)]
    pub phase_c: bool,
    #[variable(skip = true)]
    pass: Option<UnderWay>,
}

impl Grinder {
    /// Reads the machine and switches the device on.
    fn begin(&mut self, resources: &Path) -> anyhow::Result<()> {
        let path = resources.join(MACHINE);
        let model = Model::parse(&std::fs::read_to_string(&path)?, &path)?;
        self.pass = Some(UnderWay::new(&model, &Options::default())?);
        self.show();
        Ok(())
    }

    /// Runs on to an instant, s.
    fn run_to(&mut self, time_s: f64) -> anyhow::Result<()> {
        if let Some(pass) = &mut self.pass {
            pass.set_switches(self.correct, self.playback);
            pass.run_to(time_s)?;
        }
        self.show();
        Ok(())
    }

    /// Puts on the outputs what device and machine are.
    fn show(&mut self) {
        let Some(pass) = &mut self.pass else { return };
        let full_scale_um = pass.course.full_scale_um;
        let device = pass.device();
        let place = device.place();
        self.position_mm = place.position_mm;
        self.lead_error_um = place.lead_error_um;
        self.correction_um = place.correction_um;
        if let Some(last) = device.samples.last() {
            self.error_um = last.comparison.error_um(full_scale_um);
        }
        self.comparisons = i32::try_from(device.samples.len()).unwrap_or(i32::MAX);
        self.steps = i32::try_from(device.steps).unwrap_or(i32::MAX);
        self.fault = device.fault_seen;
        let engine = device.engine();
        self.count = u16::try_from(value(engine, "count")).unwrap_or(u16::MAX);
        let levels = [
            (&mut self.count_forward, "count_forward"),
            (&mut self.zero, "zero"),
            (&mut self.measuring, "measuring"),
            (&mut self.t1, "t1"),
            (&mut self.phase_a, "phase_a"),
            (&mut self.phase_b, "phase_b"),
            (&mut self.phase_c, "phase_c"),
        ];
        for (shown, name) in levels {
            *shown = value(engine, name) == 1;
        }
    }
}

/// A port of the device, by name.
fn value(engine: &mut DeviceEngine, name: &str) -> u64 {
    let mut ports = (0..).zip(&engine.netlist().signals);
    let port = ports.find(|(_, signal)| signal.path == name).map(|(id, _)| SignalId(id));
    port.map_or(0, |port| engine.value(port))
}

impl UserModel for Grinder {
    type LoggingCategory = DefaultLoggingCategory;

    fn configurate(&mut self, context: &dyn Context<Self>) -> Result<(), Fmi3Error> {
        self.begin(context.resource_path()).map_err(|error| refused(context, &error))
    }

    fn do_step(
        &mut self,
        context: &mut dyn Context<Self>,
        from_s: f64,
        step_s: f64,
        _no_way_back: bool,
    ) -> Result<CSDoStepResult, Fmi3Error> {
        let to_s = from_s + step_s;
        self.run_to(to_s).map_err(|error| refused(context, &error))?;
        context.set_time(to_s);
        Ok(CSDoStepResult::completed(to_s))
    }

    fn calculate_values(&mut self, _context: &dyn Context<Self>) -> Result<Fmi3Res, Fmi3Error> {
        Ok(Fmi3Res::OK)
    }
}

/// Says why in the log of whoever runs the unit.
fn refused(context: &dyn Context<Grinder>, error: &anyhow::Error) -> Fmi3Error {
    let category = DefaultLoggingCategory::default();
    context.log(Fmi3Error::Error.into(), category, format_args!("{error:#}"));
    Fmi3Error::Error
}

fmi_export::export_fmu!(Grinder);
