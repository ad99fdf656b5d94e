//! The response of a design as a parameter rises and falls.

use flap_core::parameter::Parameter;
use flap_sweep::notation::value::{self, UnitOf};
use flap_sweep::plan::{Along, Plan};
use flap_sweep::run::Summary;
use flap_sweep::study::response::Responses;

use super::desk::{Desk, failed};
use crate::request::{HysteresisRequest, MOST_ROWS, Number, Refused};
use crate::rows::Rows;

/// The rows of `flap respond`: up, then down.
pub(crate) fn hysteresis(desk: &Desk<'_>, request: &HysteresisRequest) -> Result<Rows, Refused> {
    let HysteresisRequest { design, x } = request;
    let plan = desk.opened.design(design)?;
    let Some(index) = Parameter::index(plan.parameters(), &x.name) else {
        return Err(Refused::impossible(format!("there is no parameter `{}`", x.name)));
    };
    if x.n < 2 || 2 * x.n as usize > MOST_ROWS {
        let error = format!("a response has 2 to {} values, not {}", MOST_ROWS / 2, x.n);
        return Err(Refused::impossible(error));
    }
    let [from, to] = [&x.from, &x.to].map(|end| number(&plan, index, end));
    let (from, to) = (from?, to?);
    let step = (to - from) / f64::from(x.n - 1);
    let (plan, along) = Along::new(plan, index, Some([from, to, step]), None, false).map_err(|error| {
        let help = Some(error.help.to_owned()).filter(|help| !help.is_empty());
        Refused::Impossible { error: error.message, help, parameter: Some(x.name.clone()) }
    })?;
    let plan = plan.following(along);
    let responses =
        Responses::of(&plan).ok_or_else(|| Refused::Fault("no parameter is followed".to_owned()))?;
    let mut rows = Rows::of(&plan);
    let options = &desk.options;
    let ran = responses.run(options, Summary::default(), &mut rows, desk.stop, &mut |_| (), &mut |_| Ok(()));
    desk.go_on()?;
    ran.map_err(|error| failed(&error))?;
    Ok(rows)
}

/// The value of a parameter, if it is allowed.
fn number(plan: &Plan, index: usize, number: &Number) -> Result<f64, Refused> {
    let parameter = &plan.parameters()[index];
    let (value, shown) = match number {
        Number::Si(value) => (value::of_number(parameter, *value), value.to_string()),
        Number::Text(text) => (value::of_text(parameter, text, UnitOf::TextOrSi), text.clone()),
    };
    value.map_err(|error| Refused::Impossible {
        error: error.message(parameter.name, &shown),
        help: error.help(),
        parameter: Some(parameter.name.to_owned()),
    })
}
