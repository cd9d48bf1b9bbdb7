//! Pages, plots, tables and waveforms; knows no grinder.
