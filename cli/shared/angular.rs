//! Keys of results in the unit of the chain: `_um`, or `_arcsec` where the errors are angles.

use serde::Serialize;
use serde_json::Value;

/// A result whose errors are in `unit`, `um` or `arcsec`, with keys that say so.
pub(crate) fn in_unit(result: &impl Serialize, unit: &str) -> anyhow::Result<Value> {
    let mut value = serde_json::to_value(result)?;
    if unit == "arcsec" {
        rename(&mut value);
    }
    Ok(value)
}

/// The key of an error in that unit.
pub(crate) fn key_in(key: &str, unit: &str) -> String {
    key.strip_suffix("_um").map_or_else(|| key.to_owned(), |stem| format!("{stem}_{unit}"))
}

fn rename(value: &mut Value) {
    match value {
        Value::Object(map) => {
            for (key, mut inner) in std::mem::take(map) {
                // Each parameter of an effect has its own unit in its key.
                if key != "parameters" {
                    rename(&mut inner);
                }
                map.insert(key_in(&key, "arcsec"), inner);
            }
        }
        Value::Array(values) => values.iter_mut().for_each(rename),
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_of_a_rotary_chain_are_angles_and_lengths_stay() {
        let result = serde_json::json!({
            "rms_um": 1.5, "rounds": [{"noise_um": 0.5, "parameters": {"eccentricity_um": 3.0}}]
        });
        let expected = r#"{"rms_arcsec":1.5,"rounds":[{"noise_arcsec":0.5,"parameters":{"eccentricity_um":3.0}}]}"#;
        assert_eq!(in_unit(&result, "arcsec").expect("plain").to_string(), expected);
        assert_eq!(in_unit(&result, "um").expect("plain"), result);
    }
}
