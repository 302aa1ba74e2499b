# Where the model's own steady states are stable: the branches against ℬ, their rates, the thresholds.


rule trace_states:
    output:
        table="results/tables/states.csv",
        thresholds="results/tables/state_thresholds.csv",
    log:
        "results/logs/trace_states.log",
    params:
        code=code_of("trace_states"),
        settings=as_json(STUDY.fiber | config["states"]),
    shell:
        "sedfiber trace_states --settings {params.settings:q}"
        " -o {output.table} --thresholds {output.thresholds} > {log} 2>&1"


rule states:
    input:
        figures_of("states"),
