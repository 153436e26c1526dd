// A form for every command, made from the server's own table of them.

function field(parameter) {
  if (parameter.choices) {
    const select = document.createElement("select");
    for (const choice of parameter.choices) select.append(new Option(choice, choice));
    return select;
  }
  const input = document.createElement("input");
  Object.assign(input, { type: "number", min: parameter.low, max: parameter.high, step: "any" });
  if (parameter.usual !== null) input.value = `${Number(parameter.usual.toFixed(3))}`;
  else input.placeholder = "preset's";
  return input;
}

function labelled(parameter, input) {
  const label = document.createElement("label");
  const range = parameter.choices ? "" : ` (${parameter.low} to ${parameter.high})`;
  label.title = `${parameter.label}${range}`;
  const name = document.createElement("span"), unit = document.createElement("span");
  name.textContent = parameter.label;
  unit.textContent = parameter.unit;
  label.append(name, input, unit);
  return label;
}

/** Empty numbers are left out: the robot's own value counts. */
function values(fields) {
  const out = {};
  for (const [parameter, input] of fields) {
    if (parameter.choices) out[parameter.name] = input.value;
    else if (input.value !== "") out[parameter.name] = Number(input.value);
  }
  return out;
}

/** @param ask resolves to whether the operator says yes. */
export function showCommands(target, commands, link, ask) {
  target.replaceChildren(...commands.map((command) => {
    const form = document.createElement("form");
    form.noValidate = true; // the server refuses with its reason, which is shown
    const button = document.createElement("button");
    button.textContent = command.title;
    button.title = command.help;
    button.dataset.command = command.name;
    form.append(button);
    const fields = command.parameters.map((parameter) => [parameter, field(parameter)]);
    if (fields.length > 0) {
      const details = document.createElement("details"), summary = document.createElement("summary");
      summary.textContent = `${command.title.toLowerCase()}: how`;
      const help = document.createElement("p");
      help.className = "help";
      help.textContent = command.help;
      for (const [parameter, input] of fields) input.name = parameter.name;
      details.append(summary, help, ...fields.map(([parameter, input]) => labelled(parameter, input)));
      form.append(details);
    }
    form.onsubmit = async (event) => {
      event.preventDefault();
      if (command.confirm && !(await ask(command.confirm))) return;
      link.request(command.name, values(fields));
    };
    return form;
  }));
}
